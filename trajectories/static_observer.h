// An observer held at constant r, outside the horizon; in flat space an observer at rest.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct StaticObserver {
  double r = kFlatSpace;  // > 2
};

inline constexpr double kStaticInnermost = 2;  // r must exceed it

// Velocity of the static frame against the rain tetrad: outward at sqrt(2/r), so
// gamma v = sqrt(2/(r - 2)) along R.
V3d static_celerity(double r);

OrbitPoint point_at(const StaticObserver& observer, double tau);

}  // namespace domefall
