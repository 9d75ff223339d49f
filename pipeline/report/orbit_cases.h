// The orbits that the report measures, each with its truth in 50 digits.
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
  // The truth, which depends on no code of trajectories: the two constants of the motion, and the
  // place at each proper time.
  Real50 energy, angular_momentum;
  std::vector<ExactPlace> places;
};

// Circular orbits at 6 and 10 M over 100 turns, and at 3.1 M over 3 turns and over 100.  The last
// is unstable, so that an error grows 400-fold with every turn, and only the closed form is tried
// over 100.  The radial fall from 30 M to 0.001 M, whose states are evenly spaced in log r.  Static
// observers, which do not fall and therefore are not integrated.  Geodesics without a closed form:
// a parabola and a hyperbola outwards from their turning points, a bound orbit over 100 turns, an
// orbit that whirls almost for ever, a fall with angular momentum, and a geodesic out of region IV.
// `states` is the number of states of each orbit.
std::vector<OrbitCase> orbit_cases(int states);

}  // namespace domefall
