#include "trajectories/observer_state.h"

#include <cmath>

namespace domefall {

Celerity<ReferenceTetrad> resting_celerity(const Spacetime& spacetime, double r, Tetrad tetrad) {
  const double celerity = spacetime.resting_celerity(r);
  return {is_outgoing(tetrad) ? -celerity : celerity, 0, 0};
}

// The T of rain has dr/dtau = -s, and that of the outgoing tetrad has s.
double radial_rate(const Spacetime& spacetime, double r, Tetrad tetrad,
                   const Celerity<ReferenceTetrad>& celerity) {
  const double s = spacetime.free_fall_speed(r), gamma = gamma_of(celerity);
  return celerity.x + (is_outgoing(tetrad) ? s * gamma : -s * gamma);
}

Celerity<RestFrame> static_celerity(const ObserverState& o) {
  // For the observer at rest dr is the length dr/sqrt(f).
  const double rate = radial_rate(o.spacetime, o.r, o.tetrad, o.celerity);
  return {rate / std::sqrt(o.spacetime.lapse_squared(o.r)), o.celerity.y, o.celerity.z};
}

// The two tetrads move at s and -s against the observer at rest, so they recede from each other at
// 2s/(1 + s^2).  The gamma of this velocity is (1 + s^2)/(1 - s^2).
Celerity<RainTetrad> rain_celerity(const Spacetime& spacetime, double r, Tetrad tetrad,
                                   const Celerity<ReferenceTetrad>& celerity) {
  if (!is_outgoing(tetrad)) return Celerity<RainTetrad>(celerity);
  const double s = spacetime.free_fall_speed(r), below = (1 - s) * (1 + s);
  return {((1 + s * s) * celerity.x + 2 * s * gamma_of(celerity)) / below, celerity.y, celerity.z};
}

}  // namespace domefall
