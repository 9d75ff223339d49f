// These orbits come from outside the hole.  They are of what falls from rest, what is captured from
// infinity, and anything that is thrown, wherever that takes it.  L is in M, and celerities are
// gamma v, with components along R (outward) and Phi.  The tangential one is >= 0, because Phi is
// the direction of the motion.  A thrown Lorentz factor may be 1e6 and more.  The functions throw
// std::domain_error that names the bound.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

// Returns the fall from rest at infinity with 0 <= L < 4.  tau = 0 at from_r (any r > 0), on the
// way in.
Geodesic fall_from_infinity(double angular_momentum, double from_r);
// Returns the same with the speed v at infinity (fraction of c) and an impact parameter below
// capture_impact_parameter(v) of hyperbolic_orbit.h.
Geodesic fall_with_speed(double speed, double impact_parameter, double from_r);

// Returns the fall from rest in r at from_r > 2, where tau = 0.  L must be less than
// fall_bound(from_r), beyond which from_r would be a periastron or a stable orbit's apoastron.  For
// from_r <= 3 any L falls, and the bound is infinity.
Geodesic fall_from_rest(double from_r, double angular_momentum);
double fall_bound(double from_r);

// Returns the orbit of what is thrown at r > 2 with that celerity against the static observer.  It
// falls in, comes around, stays bound or escapes.  tau = 0 at r.
Geodesic thrown_outside(double r, double radial, double tangential);
// Returns the orbit of what is thrown at r > 0, inside the hole or out, with that celerity against
// the rain.  tau = 0 at r.  If its energy is negative it moves towards region III.  Then it is that
// geodesic of positive energy mirrored, given in the rain tetrad of III.  An energy below 1e-14
// gamma is 0.
Geodesic thrown_from_rain(double r, double radial, double tangential);

}  // namespace domefall
