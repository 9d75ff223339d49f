// A GivenVelocity is an observer whose place and four-velocity are simply given.  It is one instant
// of any motion, held.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct GivenVelocity {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;  // has_tetrad(region, tetrad)
  double r = kFlatSpace;          // > 2 in I and III, at most 2 in II and IV
  V3d celerity{0, 0, 0};          // gamma v against the tetrad, components (R, Theta, Phi)

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
  bool is_at_rest(const Spacetime& spacetime) const;
};

// Returns gamma v against the tetrad of an observer that has the celerity `own` in the frame of an
// observer of celerity `frame`, whose axes are the tetrad's, boosted ([Riazuelo] eq. Lambda_cov).
// It takes celerities because a speed in double precision holds no Lorentz factor beyond 1e8.
V3d celerity_against(const V3d& frame, const V3d& own);

}  // namespace domefall
