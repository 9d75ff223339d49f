#include "trajectories/circular_orbit.h"

#include <cmath>
#include <numbers>

namespace domefall {

double period(const CircularOrbit& orbit) {
  return 2 * std::numbers::pi * orbit.r * std::sqrt(orbit.r - 3);
}

// In the rain tetrad u^Phi = L/r = 1/sqrt(r - 3), and u^R = sqrt(2/r) E/(1 - 2/r) since u^r = 0.
OrbitPoint CircularOrbit::at(const ProperTime& tau) const {
  const double azimuth = double(tau) / (r * std::sqrt(r - 3));
  return {Region::kI,
          Tetrad::kRain,
          r,
          azimuth,
          {std::sqrt(2 / (r - 3)), 0, 1 / std::sqrt(r - 3)},
          double(tau) / std::sqrt(1 - 3 / r)};
}

}  // namespace domefall
