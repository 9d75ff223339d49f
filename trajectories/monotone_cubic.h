// Cubics between keys, once continuously differentiable, that do not overshoot the keys.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

namespace domefall {

// A HermiteCubic is c0 + t (c1 + t (c2 + t c3)) for t = 0 to 1, with these values and slopes (per
// unit of t) at both ends.
struct HermiteCubic {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

  HermiteCubic() = default;
  HermiteCubic(double from, double to, double slope_from, double slope_to)
      : c0(from),
        c1(slope_from),
        c2(3 * (to - from) - 2 * slope_from - slope_to),
        c3(slope_from + slope_to - 2 * (to - from)) {}

  double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  double slope(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
  double size() const { return std::abs(c0) + std::abs(c1) + std::abs(c2) + std::abs(c3); }
};

// Returns the slope at a key between two stretches of these lengths and mean slopes, with which the
// curve is monotone wherever its keys are (Fritsch and Butland 1984).  It is 0 at an extreme, and
// else the harmonic mean weighted towards the shorter stretch.
inline double monotone_slope(double length_before, double before, double length_after,
                             double after) {
  if (!(before * after > 0)) return 0;
  const double a = 2 * length_after + length_before, b = length_after + 2 * length_before;
  return (a + b) / (a / before + b / after);
}

// Returns the cubics between keys, of which there are at least two, in the order of their times.
// `rates` holds the slopes by time that are given.  The others are such slopes, and at the first and
// the last key those of the parabola through the next two, within what keeps the curve from turning.
std::vector<HermiteCubic> cubics_between(const std::vector<double>& taus,
                                         const std::vector<double>& values,
                                         const std::vector<std::optional<double>>& rates);

// Returns where the cubic turns, between 0 and 1, with both ends.
std::vector<double> turns_of(const HermiteCubic& c);

// Returns where the cubic, which must not turn between low and high, has the value.
double where(const HermiteCubic& c, double value, double low, double high);

}  // namespace domefall
