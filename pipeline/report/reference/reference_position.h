// Where a ray is after having swept an angle, and when its light was there, as the truth for
// places: w'' = 3 w^2 - w, w = 1/r, by Taylor series of order 32 in 50-digit arithmetic.  It shares
// no code with pipeline/optics.
#pragma once

#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

struct ReferenceRayPlace {
  double r;  // units of M
  // v = t + r* of the place less that of the observer, u = t - r* for outgoing and T_IV, with r* =
  // r + 2 ln|r/2 - 1|, units of M.  Infinite or NaN for an observer at r = 2 itself whose
  // coordinate is that of the other horizon.
  double null_time;
};

// The place after psi > 0 radians, which must be on the ray's path, back in time.  An error of
// 1e-50 at the observer grows like e^psi beside an edge.  A ray takes some milliseconds.
ReferenceRayPlace reference_position(const ReferenceRequest& q, double psi);

}  // namespace domefall
