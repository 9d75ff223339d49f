// An observer whose place and four-velocity are simply given: one instant of any motion, held.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct GivenVelocity {
  double r = kFlatSpace;  // > 0; region I outside the horizon, II at r <= 2
  V3d celerity{0, 0, 0};  // gamma v against the rain tetrad, components (R, Theta, Phi)
};

// gamma v of an observer that moves with `speed` (in [0, 1), of light) along `direction` (unit,
// components (R, Theta, Phi)) as seen from an observer with celerity `frame`, itself against the
// rain tetrad; the direction is boosted with that frame ([Riazuelo] eq. Lambda_cov).
V3d celerity_against(const V3d& frame, double speed, const V3d& direction);

OrbitPoint point_at(const GivenVelocity& observer, double tau);

}  // namespace domefall
