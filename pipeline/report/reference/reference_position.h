// Where a ray is after having swept an angle, as the truth for positions: w'' = 3 w^2 - w, w = 1/r,
// by Taylor series of order 32 in 50-digit arithmetic.  It shares no code with pipeline/optics.
#pragma once

#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

// r (M) after psi > 0 radians, which must be on the ray's path, back in time.  An error of 1e-50 at
// the observer grows like e^psi beside an edge.  A ray takes some milliseconds.
double reference_position(const ReferenceRequest& q, double psi);

}  // namespace domefall
