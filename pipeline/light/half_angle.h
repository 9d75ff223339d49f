// A HalfAngle is the sine and cosine of half an angle.  They keep their relative accuracy where the
// angle is near 0 or pi and its own sine and cosine have lost it.
#pragma once

#include <cmath>

namespace domefall {

struct HalfAngle {
  double sine, cosine;

  double angle() const { return 2 * std::atan2(sine, cosine); }  // the whole one, radians
};

// Returns the half of an angle in [0, pi] that is given by its cosine and sine.  Of the two
// half-angle formulas sin^2(delta/2) = (1 - cos delta)/2 and cos^2(delta/2) = (1 + cos delta)/2 the
// one that does not cancel gives the larger.  The smaller follows from sin delta = 2 sin(delta/2)
// cos(delta/2).
inline HalfAngle half_angle(double cos_delta, double sin_delta) {
  const double larger = std::sqrt((1 + std::abs(cos_delta)) / 2);
  const double smaller = sin_delta / (2 * larger);
  return cos_delta >= 0 ? HalfAngle{smaller, larger} : HalfAngle{larger, smaller};
}

// Returns the half of an angle in [0, pi] that is given by tan(delta/2), which is infinite for pi.
inline HalfAngle half_angle_of_tangent(double tangent) {
  const double cosine = 1 / std::hypot(1, tangent);
  return {std::isinf(tangent) ? 1 : tangent * cosine, cosine};
}

}  // namespace domefall
