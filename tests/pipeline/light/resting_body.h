// Bodies that rest or circle freely.
#pragma once

#include <cmath>
#include <limits>

#include "pipeline/light/body_image.h"
#include "pipeline/light/emission_time.h"
#include "pipeline/spacetime/charged.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

// At rest at r > 2; t = 0 at tau = 0.
inline BodyMotion resting_body(double r, const V3d& direction) {
  constexpr double kForEver = std::numeric_limits<double>::infinity();
  // Against the rain it moves outwards: gamma v = sqrt(2/r)/sqrt(1 - 2/r).
  const double outwards = std::sqrt(2 / (r - 2));
  return {[=](double tau) {
            return BodyPoint{direction,
                             r,
                             tau / std::sqrt(1 - 2 / r) + Schwarzschild::tortoise(r),
                             std::sqrt(1 + outwards * outwards),
                             outwards,
                             V3d(0, 0, 0)};
          },
          -kForEver, kForEver};
}

// Against T, near a charge, on a circle about `axis`; t = 0 at tau = 0.
inline BodyMotion circling_body(const ChargedHole& hole, double r, const V3d& axis,
                                const V3d& start) {
  const double q2 = hole.charge * hole.charge, root = std::sqrt(r * r - 3 * r + 2 * q2);
  const double turning = std::sqrt(r - q2) / root, u_t = r / root;
  const double out =
      hole.radial_celerity(hole.at(r), 0, u_t * hole.lapse_squared(r), turning * turning, false);
  return {[=](double tau) {
            const double phi = turning / r * tau;
            return BodyPoint{start * std::cos(phi) + axis.cross(start) * std::sin(phi),
                             r,
                             u_t * tau + hole.tortoise(r),
                             std::sqrt(1 + out * out + turning * turning),
                             out,
                             axis * (r * turning)};
          },
          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

}  // namespace domefall
