// A RadialInfall is radial free fall from rest at infinity, the rain frame itself, with u = T_I of
// [Riazuelo] eq. tetrad_start.  r^(3/2) = r0^(3/2) - (3/sqrt 2) tau is regular through the horizon.
// In the second half of the fall r is computed as the 2/3 power of (3/sqrt 2) of the time left, so
// that it is right to 4 epsilon at any depth.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct RadialInfall {
  double from_r = 30;  // > 0: r at tau = 0
};

// Returns the proper time from from_r to the singularity, rounded.  point_at() counts from the
// rounded one.
double time_to_singularity(const RadialInfall& fall);

// Returns the proper time from from_r to r, for 0 <= r <= from_r, without cancellation as r ->
// from_r or 0.
ProperTime proper_time_to(const RadialInfall& fall, double r);

// tau is from 0 to below time_to_singularity.
OrbitPoint point_at(const RadialInfall& fall, const ProperTime& tau);

}  // namespace domefall
