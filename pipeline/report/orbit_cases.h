// orbit_cases() lists the orbits that the report measures, each with its truth in 50 digits.
#pragma once

#include <string>
#include <vector>

#include "pipeline/report/reference/reference_orbit.h"
#include "trajectories/trajectory.h"

namespace domefall {

struct ExactPlace {
  Real50 r, azimuth;  // M, radians
};

struct OrbitCase {
  std::string name;
  Trajectory trajectory;
  std::vector<double> taus;  // proper times of the states, M
  bool integrated;           // whether the orbit is also integrated step by step
  // The truth is the two constants of the motion and the place at each proper time.  It depends on
  // no code of trajectories.
  Real50 energy, angular_momentum;
  std::vector<ExactPlace> places;
};

// Returns all orbits, each with `states` states.
//
// There are circular orbits at 6 and 10 M over 100 turns, and at 3.1 M over 3 turns and over 100.
// The circle at 3.1 M is unstable: an error grows by exp(2 pi sqrt(6/r - 1)), more than 400-fold,
// with every turn.  So only the closed form is tried over 100 turns.
//
// The radial fall goes from 30 M to 0.001 M, and its states are evenly spaced in log r.  Static
// observers do not fall and therefore are not integrated.
//
// The geodesics without a closed form are a parabola and a hyperbola outwards from their turning
// points, a bound orbit over 100 turns, an orbit that whirls almost for ever, a fall with angular
// momentum, and a geodesic out of region IV.
std::vector<OrbitCase> orbit_cases(int states);

}  // namespace domefall
