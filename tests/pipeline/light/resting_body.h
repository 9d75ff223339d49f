// A body that stays where it is.
#pragma once

#include <cmath>
#include <limits>

#include "pipeline/light/body_image.h"
#include "pipeline/light/emission_time.h"
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

}  // namespace domefall
