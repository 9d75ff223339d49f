// What the closed forms and the quadratures of trajectories are worth: their error and their cost, beside those of
// integrating the same orbits step by step.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// One orbit by one method, over the states of a thousand frames (quick: a hundred).  All errors are
// the largest of these states, evaluated with 50 digits.
struct OrbitErrorRow {
  std::string orbit;
  std::string method;  // "closed form", "quadrature", or a method of integrated_fall.h
  double tolerance;    // of a step of the integration; 0 for the first two
  // What is left of the orbit's constants in an emitted state (r, gamma, celerity against the rain
  // tetrad): |gamma - s w - E|, |r v - L| (M) and |u.u - 1|, each absolute; s = sqrt(2/r), w and v the
  // components of the celerity.  A trajectory emits no gamma.  It is what the celerity gives in
  // energy_drift, and what the orbit's energy leaves in norm_drift: E + s w.
  double energy_drift, angular_momentum_drift, norm_drift;
  double r_error;    // relative; 1 if the integration has met the singularity before
  double phi_error;  // radians
  double seconds;    // CPU, for a thousand states one after another
};

// Circular orbits at 6 and 10 M over 100 turns, at 3.1 M (unstable: an error grows 400-fold with every
// turn) over 3 and, by the closed form alone, over 100; the radial fall from 30 M to 0.001 M, the states
// evenly spaced in log r; static observers, which do not fall and have a closed form only.
// The references are the formulas of circular_orbit.h, radial_infall.h and static_observer.h with 50
// digits, at the same proper times.
// And geodesics: a parabola and a hyperbola from their turning points out, a bound orbit over 100 turns,
// one that whirls for ever (nearly), a fall with angular momentum, and one out of region IV.  Their
// references are the integrals of reference_orbit.h.  Measured: quick 0.3 s, else 1.8 s.
std::vector<OrbitErrorRow> measure_orbits(bool quick);

}  // namespace domefall
