// Between a periastron and an apoastron for ever: r = p/(1 + e cos chi), p > 6 + 2e, 0 <= e < 1;
// E^2 = ((p - 2)^2 - 4 e^2)/(p (p - 3 - e^2)), L^2 = p^2/(p - 3 - e^2).  tau = 0 at a periastron.
// Near p = 6 + 2e the orbit whirls at its periastron.  Throws std::domain_error that names the
// bound.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

Geodesic bound_by_turning_points(double periastron, double apoastron);
Geodesic bound_by_shape(double p, double e);
// p = 6 + 2e + excess, excess >= 1e-20 M.
Geodesic bound_by_excess(double e, double excess);

}  // namespace domefall
