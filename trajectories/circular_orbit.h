// A geodesic circular orbit: L^2 = r/(1 - 3/r), E = (1 - 2/r)/sqrt(1 - 3/r), v = 1/sqrt(r - 2)
// against the static frame.  [Riazuelo] app. app_img, circular orbits (with M r^2 - L^2 r + 3 L^2 M
// = 0; the text has L^3).  Unstable below r = 6, still a solution.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct CircularOrbit {
  double r = 6;  // > 3
};

inline constexpr double kCircularInnermost = 3;  // r must exceed it: there light itself circles

// Proper time of one revolution, units of M: 2 pi r sqrt(r - 3).
double period(const CircularOrbit& orbit);

OrbitPoint point_at(const CircularOrbit& orbit, double tau);

}  // namespace domefall
