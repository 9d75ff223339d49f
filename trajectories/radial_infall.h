// Radial free fall from rest at infinity, the rain frame itself: u = T_I of [Riazuelo]
// eq. tetrad_start.  r^(3/2) = r0^(3/2) - (3/sqrt 2) tau, regular through the horizon.  Of the
// second half of the fall it is computed as the 2/3 power of (3/sqrt 2) of the time left, so that r
// is right to 4 epsilon at any depth.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct RadialInfall {
  double from_r = 30;  // > 0: r at tau = 0
};

// Proper time from from_r to the singularity, rounded; point_at() counts from the rounded one.
double time_to_singularity(const RadialInfall& fall);

// Proper time from from_r to r, for 0 <= r <= from_r, without cancellation as r -> from_r or 0.
ProperTime proper_time_to(const RadialInfall& fall, double r);

// tau from 0 to below time_to_singularity.
OrbitPoint point_at(const RadialInfall& fall, const ProperTime& tau);

}  // namespace domefall
