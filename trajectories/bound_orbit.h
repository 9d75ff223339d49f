// A bound orbit stays between a periastron and an apoastron for ever.  It has
// r = p/(1 + e cos chi), with p > 6 + 2e and 0 <= e < 1.  Its constants are
// E^2 = ((p - 2)^2 - 4 e^2)/(p (p - 3 - e^2)) and L^2 = p^2/(p - 3 - e^2).  tau = 0 at a
// periastron.  Near p = 6 + 2e the orbit whirls at its periastron.  The functions throw
// std::domain_error that names the bound.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

Geodesic bound_by_turning_points(double periastron, double apoastron);
Geodesic bound_by_shape(double p, double e);
// Here p = 6 + 2e + excess, with excess >= 1e-20 M.
Geodesic bound_by_excess(double e, double excess);

}  // namespace domefall
