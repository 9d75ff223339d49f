// A hyperbolic orbit comes from infinity with a speed v, goes around the hole and back ([Riazuelo]
// app. app_img, fig. fighy1).  E = 1/sqrt(1 - v^2), and L = b v E for an impact parameter b (M).
// tau = 0 at the periastron.  v is between 1e-9 and 1 - 1e-12, as a fraction of c.  The functions
// throw std::domain_error that names the bound.  The speed that a periastron needs is named in
// km/s, too.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

inline constexpr double kHyperbolicInnermost = 3;  // M; the periastron must exceed it

// Returns the speed at infinity that an orbit which turns at r_p must exceed, as a fraction of c.
// It is sqrt((e^2 - 1)/8) = sqrt(4 - r_p)/(r_p - 2) with e = (6 - r_p)/(r_p - 2), and 0 for
// r_p >= 4.
double slowest_speed_at_infinity(double periastron);
// These return the impact parameter (M) that an orbit of that speed must exceed to come back, and
// its L (M).
double capture_impact_parameter(double speed);
double capture_angular_momentum(double speed);

Geodesic hyperbolic_by_periastron(double speed, double periastron);
Geodesic hyperbolic_by_impact_parameter(double speed, double impact_parameter);
// These are for orbits close to the bounds, to full accuracy.  One has
// v = slowest_speed_at_infinity(r_p) (1 + excess) with 3 < r_p < 4.  The other has
// b = capture_impact_parameter(v) (1 + excess).  excess >= 1e-20.
Geodesic hyperbolic_by_speed_excess(double periastron, double excess);
Geodesic hyperbolic_by_impact_excess(double speed, double excess);

}  // namespace domefall
