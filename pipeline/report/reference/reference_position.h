// reference_position() says where a ray is after it has swept an angle, and when its light was
// there, as the truth for places along rays.  It solves w'' = 3 w^2 - w, with w = 1/r, by Taylor
// series of order 32 in 50-digit arithmetic, and shares no code with pipeline/light.
#pragma once

#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

struct ReferenceRayPlace {
  double r;  // units of M
  // This is v = t + r* of the place less v of the observer or, for outgoing and T_IV, the same
  // difference of u = t - r*, in units of M.  Here r* = r + 2 ln|r/2 - 1|.  It is infinite or NaN
  // for an observer at r = 2 itself whose coordinate is that of the other horizon.
  double null_time;
};

// Returns the place after psi > 0 radians, back in time.  It must be on the ray's path.  An error
// of 1e-50 at the observer grows like e^psi beside an edge.  A ray takes some milliseconds.
ReferenceRayPlace reference_position(const ReferenceRequest& q, double psi);

}  // namespace domefall
