// An observer held at constant r, outside the horizon; in flat space an observer at rest.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct StaticObserver {
  double r = kFlatSpace;  // > 2
};

inline constexpr double kStaticInnermost = 2;  // r must exceed it

// gamma v against the tetrad of what is at rest in r (outside) or in t (inside: T_II and T_IV of
// [Riazuelo] eq. TR_IV), components (R, Theta, Phi).  r != 2.  u lies along d/dt outside and
// orthogonal to it inside, and d/dt is T + s R in rain, T - s R in the outgoing frame, s =
// sqrt(2/r).
V3d resting_celerity(double r, Tetrad tetrad = Tetrad::kRain);

OrbitPoint point_at(const StaticObserver& observer, double tau);

}  // namespace domefall
