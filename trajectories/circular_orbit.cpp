#include "trajectories/circular_orbit.h"

#include <cmath>
#include <numbers>

namespace domefall {

double period(const CircularOrbit& orbit) {
  return 2 * std::numbers::pi * orbit.r * std::sqrt(orbit.r - 3);
}

// In the rain tetrad u^Phi = L/r = 1/sqrt(r - 3), and u^R = sqrt(2/r) E/(1 - 2/r) since u^r = 0.
OrbitPoint point_at(const CircularOrbit& orbit, double tau) {
  const double azimuth = tau / (orbit.r * std::sqrt(orbit.r - 3));
  return {Region::kI,
          Tetrad::kRain,
          orbit.r,
          azimuth,
          V3d(std::sqrt(2 / (orbit.r - 3)), 0, 1 / std::sqrt(orbit.r - 3)),
          tau / std::sqrt(1 - 3 / orbit.r)};
}

}  // namespace domefall
