// RayTimes say when light left a place on its way to the observer, for many rays at a time.
//
// Times count in the observer's own null coordinate, as in emission_time.h.  It is v = t + r* in
// the rain frame and u = t - r* in the outgoing frame, with r* = r + 2 ln|r/2 - 1|.  The same
// coordinate at the place is finite unless it belongs to another horizon, as v does on the past one
// and u on the future one.
#pragma once

#include "pipeline/light/ray_orbits.h"

namespace domefall {

// PathTimes hold what stays the same along each ray.  These are the integral N of orbit_time.h over
// the whole path and up to the observer, from its back end, and r* of the orbit's turning point, if
// it has one.
struct PathTimes {
  alignas(64) RayPlaces::Column total, observer, turn;
};

class RayTimes {
 public:
  // The orbits must outlive the times, unchanged.
  explicit RayTimes(const RayOrbits& orbits);

  // Finds v (u in the outgoing frame) at each place less that at the observer, in units of M.  It
  // is negative for light on its way from region I.  `places` are those that the orbits find at
  // psi.  The time is 0 where a ray has ended, and exact_emission_time at r = 0.  Measured against
  // quadrature of the metric outside and of N on the way through the horizon, it is within 1e-11
  // (1 + |v|), next to an edge too, beside what an error of psi makes of it.  The rays take 150 ns
  // each once, and a place 45 ns (AVX2, g++ 12 -O3).
  void find(const double* psi, const RayPlaces& places, double* times) const;

 private:
  const RayOrbits& orbits_;
  PathTimes paths_;
};

}  // namespace domefall
