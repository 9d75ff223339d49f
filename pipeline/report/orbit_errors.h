// measure_orbits() compares error and cost of the closed forms and quadratures of trajectories with
// those of integrating the same orbits step by step.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// An OrbitErrorRow is one orbit by one method, over the states of a thousand frames, or of a
// hundred if quick.  Every error is the largest over these states, evaluated with 50 digits.
struct OrbitErrorRow {
  std::string orbit;
  std::string method;  // "closed form", "quadrature", or a method of integrated_fall.h
  double tolerance;    // of a step of the integration; 0 for the first two methods
  // These say how far an emitted state is from the orbit's constants.  Let s = sqrt(2/r), and let w
  // and v be the components of the celerity against the rain along R and Phi.  The drifts are then
  // |gamma - s w - E|, |r v - L| (M) and |u.u - 1|, none of them relative.  A trajectory emits no
  // gamma.  For it, gamma is sqrt(1 + w^2 + v^2) in energy_drift and E + s w in norm_drift.
  double energy_drift, angular_momentum_drift, norm_drift;
  double r_error;    // relative; 1 if the integration has met the singularity too early
  double phi_error;  // radians
  double seconds;    // CPU, for a thousand states one after another
};

// Measures some orbits of every kind, each by every method that it has.  This takes 0.3 s if quick,
// else 1.8 s.
std::vector<OrbitErrorRow> measure_orbits(bool quick);

}  // namespace domefall
