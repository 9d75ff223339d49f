// A StaticObserver is held at constant r, outside the horizon.  In flat space it is an observer at
// rest.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct StaticObserver {
  double r = kFlatSpace;  // > 2
};

inline constexpr double kStaticInnermost = 2;  // r must exceed it

// Returns gamma v against the tetrad, with components (R, Theta, Phi), of what is at rest in r
// (outside) or in t (inside, T_II and T_IV of [Riazuelo] eq. TR_IV), for r != 2.  u lies along d/dt
// outside and orthogonal to it inside.  d/dt is T + s R in rain and T - s R in the outgoing frame,
// with s = sqrt(2/r).
V3d resting_celerity(double r, Tetrad tetrad = Tetrad::kRain);

OrbitPoint point_at(const StaticObserver& observer, double tau);

}  // namespace domefall
