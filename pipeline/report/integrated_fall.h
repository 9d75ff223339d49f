// Free fall, integrated step by step: the way without a closed form, and the independent check of
// one.  The geodesic equation ([Riazuelo] eq. deb_ode1 to fin_ode1, which hold for any
// four-velocity) with the four-velocity in the rain tetrad ([Riazuelo] eq. tetrad_start), which is
// regular at the horizon, and in Cartesian components, in which no orbit is at rest: with s =
// sqrt(2/r), n = x/r, u = gamma T + (celerity c),
//
//     x' = c - s gamma n      c' = (s gamma/r) (c - 3/2 (c.n) n)      gamma' = (s/r) (c^2 - 3/2 (c.n)^2)
//
// These are the Euler-Lagrange equations of (t'^2 - |x' + s t' n|^2)/2, t the rain's own time, t' =
// gamma.  Nothing is put in of what stays the same, energy gamma - s c.n, angular momentum x cross
// c, norm gamma^2 - c^2; so each shows the error of the steps.
#pragma once

#include <vector>

namespace domefall {

// A body in the plane of its motion.
struct FallState {
  double r = 0;           // units of M; 0: it has met the singularity
  double azimuth = 0;     // radians, whole turns counted
  double gamma = 1;       // Lorentz factor against the rain
  double radial = 0;      // celerity along R
  double tangential = 0;  // celerity along Phi
};

// Runge-Kutta pairs of Boost.Odeint with controlled steps.
enum class FallMethod {
  kDopri5,      // Dormand and Prince, order 5
  kFehlberg78,  // Fehlberg, order 7
};

// The states at the proper times `taus` (M, ascending; the start is at 0).  The error of a step is
// kept below tolerance (1 + |y| + |dy|) in each of the five numbers.  Steps are as long as that
// allows, but no more than half the way to the centre or 2 radians around it; a state between two
// of them is reached by a step of its own.  A body that has come below 1e-6 M has met the
// singularity: from there its states have r = 0 and are otherwise its last one.  Throws
// std::runtime_error if the steps become too many.
std::vector<FallState> integrate_fall(const FallState& start, const std::vector<double>& taus,
                                      FallMethod method, double tolerance);

}  // namespace domefall
