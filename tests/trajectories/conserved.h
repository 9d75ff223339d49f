// What the four-velocity of an emitted state says in any spacetime, by the components of d/dt along T
// and R: E = along_t gamma - along_r w and dr/dtau = along_t w - along_r gamma.
#pragma once

#include <cmath>
#include <vector>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// Of holes, extremal ones and naked singularities.
inline std::vector<long double> charges() {
  return {1e-7L, 0.1L, 0.5L, 0.8L, 0.99L, 1 - 1e-12L, 1.0L, 1.0L + 1e-12L, 1.03L, 1.2L, 5.0L};
}

struct Conserved {
  double energy, radial, momentum;  // radial is dr/dtau
  double scale;                     // of the terms that energy and radial are the sums of
  double rounding;                  // what rounding of r does to them
};

// With f = along_t^2 - along_r^2, both are made of f (gamma + w) and gamma - w.
inline Conserved conserved_by(const Spacetime& spacetime, const OrbitPoint& p) {
  const StaticTime time = spacetime.static_time(p.r);
  const double f = spacetime.lapse_squared(p.r);
  const double sum =
      time.along_r > 0 ? time.along_t + time.along_r : f / (time.along_t - time.along_r);
  const double w = is_outgoing(p.tetrad) ? -p.celerity.x : p.celerity.x;
  const double gamma = std::sqrt(1 + p.celerity.length2()),
               across = 1 + p.celerity.z * p.celerity.z;
  const double falling = w > 0 ? across / (gamma + w) : gamma - w;
  constexpr double kStep = 1e-6;  // of r
  const double slope =
      (spacetime.lapse_squared(p.r * (1 + kStep)) - spacetime.lapse_squared(p.r * (1 - kStep))) /
      (2 * kStep);
  const double rising = f / sum * (across / falling), left = sum * falling;
  return {(rising + left) / 2, (is_outgoing(p.tetrad) ? left - rising : rising - left) / 2,
          p.r * p.celerity.z, std::abs(rising) + left,
          4e-16 * std::abs(slope) * across / falling / sum};
}

}  // namespace domefall
