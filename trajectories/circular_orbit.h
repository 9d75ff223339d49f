// A CircularOrbit is a geodesic circular orbit.  It has L^2 = r/(1 - 3/r),
// E = (1 - 2/r)/sqrt(1 - 3/r), and v = 1/sqrt(r - 2) against the static frame.  It is in [Riazuelo]
// app. app_img, circular orbits, whose equation must be M r^2 - L^2 r + 3 L^2 M = 0, where the text
// has L^3.  It is unstable below r = 6, but still a solution.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct CircularOrbit {
  double r = 6;  // > 3

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
};

// Returns the proper time of one revolution, 2 pi r sqrt(r - 3), in units of M.
double period(const CircularOrbit& orbit);

}  // namespace domefall
