// Radial free fall from rest at infinity, the rain frame itself: u = T_I of [Riazuelo]
// eq. tetrad_start.  r^(3/2) = r0^(3/2) - (3/sqrt 2) tau, regular through the horizon.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct RadialInfall {
  double from_r = 30;  // > 0: r at tau = 0
};

// Proper time (M) from from_r to r, for 0 <= r <= from_r, without cancellation as r -> from_r.
double proper_time_to(const RadialInfall& fall, double r);

OrbitPoint point_at(const RadialInfall& fall, double tau);

}  // namespace domefall
