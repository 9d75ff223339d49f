// integrate_fall() follows a freely falling body step by step.  It needs no closed form, so it
// checks the closed forms of trajectories independently.  The four-velocity of the geodesic
// equation, [Riazuelo] eq. deb_ode1 to fin_ode1, is held in the rain tetrad,
// [Riazuelo] eq. tetrad_start, which is regular at the horizon.  Its components are Cartesian, in
// which even a circular orbit is not a fixed point of the equations.  With s = sqrt(2/r), n = x/r
// and u = gamma T + c, where c is the celerity,
//
//     x' = c - s gamma n    c' = (s gamma/r)(c - 3/2 (c.n) n)    gamma' = (s/r)(c^2 - 3/2 (c.n)^2)
//
// These are the Euler-Lagrange equations of (t'^2 - |x' + s t' n|^2)/2, where t is the rain's own
// time and t' = gamma.  The momentum of x is -c, and at a fixed c the gradient of s c.n is
// (s/r)(c - 3/2 (c.n) n), because ds/dr = -s/(2r).  The third equation is gamma gamma' = c.c',
// which follows from gamma^2 = 1 + c^2.
//
// The constants of the motion are the energy gamma - s c.n, the angular momentum x cross c and the
// norm gamma^2 - c^2.  They are not used, so each of them shows the error of the steps.
#pragma once

#include <vector>

namespace domefall {

// A FallState is the state of a body in the plane of its motion.
struct FallState {
  double r = 0;           // units of M; 0 once the body has met the singularity
  double azimuth = 0;     // radians, whole turns counted
  double gamma = 1;       // Lorentz factor against the rain
  double radial = 0;      // celerity along R
  double tangential = 0;  // celerity along Phi
};

// Both methods are Runge-Kutta pairs of Boost.Odeint with controlled steps.
enum class FallMethod {
  kDopri5,      // Dormand and Prince, order 5
  kFehlberg78,  // Fehlberg, order 7
};

// Returns the states at the proper times `taus`, which are in units of M and ascend from the start
// at 0.  The error of a step is kept below tolerance (1 + |y| + |dy|) in each of the five numbers.
// Steps are as long as that allows, but no longer than half the way to the centre or 2 radians
// around it.  A state between two steps is reached by a step of its own.  A body below 1e-6 M has
// met the singularity, and all its later states equal its last one except that r = 0.  Throws
// std::runtime_error if the steps become too many.
std::vector<FallState> integrate_fall(const FallState& start, const std::vector<double>& taus,
                                      FallMethod method, double tolerance);

}  // namespace domefall
