// What the four-velocity of an emitted state says.
#pragma once

#include <cmath>

#include "trajectories/orbit_point.h"

namespace domefall {

inline double gamma_of(const OrbitPoint& p) { return std::sqrt(1 + p.celerity.dot(p.celerity)); }

// d/dt = T + s R in rain, T - s R in the outgoing frame.
inline double energy_of(const OrbitPoint& p) {
  const double s = std::sqrt(2 / p.r);
  return gamma_of(p) + (is_outgoing(p.tetrad) ? s : -s) * p.celerity.x;
}

inline double radial_speed_of(const OrbitPoint& p) {
  const double s = std::sqrt(2 / p.r);
  return p.celerity.x + (is_outgoing(p.tetrad) ? s : -s) * gamma_of(p);
}

inline double angular_momentum_of(const OrbitPoint& p) { return p.r * p.celerity.z; }

inline double tortoise_of(double r) { return r + 2 * std::log(std::abs(r / 2 - 1)); }

}  // namespace domefall
