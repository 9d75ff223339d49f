// A RadialInfall is radial free fall from rest at infinity, the rain frame itself, with u = T_I of
// [Riazuelo] eq. tetrad_start.  r^(3/2) = r0^(3/2) - (3/sqrt 2) tau is regular through the horizon.
// In the second half of the fall r is computed as the 2/3 power of (3/sqrt 2) of the time left, so
// that it is right to 4 epsilon at any depth.
#pragma once

#include <optional>
#include <utility>

#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

struct RadialInfall {
  double from_r = 30;  // > 0: r at tau = 0

  OrbitPoint at(const ProperTime& tau) const;  // from 0 to below death()
  static double birth() { return -kInfinity; }
  // Returns the proper time from from_r to the singularity, rounded.  at() counts from the rounded
  // one.
  double death() const;
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after) const;
  std::pair<double, double> reach() const { return {0, from_r}; }
};

// Returns the proper time from from_r to r, for 0 <= r <= from_r, without cancellation as r ->
// from_r or 0.
ProperTime proper_time_to(const RadialInfall& fall, double r);

}  // namespace domefall
