#include "trajectories/observer_state.h"

#include <cmath>

namespace domefall {

V3d resting_celerity(const Spacetime& spacetime, double r, Tetrad tetrad) {
  const double celerity = spacetime.resting_celerity(r);
  return {is_outgoing(tetrad) ? -celerity : celerity, 0, 0};
}

V3d static_celerity(const ObserverState& o) {
  // The reference frame falls at -s or rises at s, so dr/dtau = c_R -+ s gamma.  For the static
  // observer dr is the length dr/sqrt(f).
  const double s = o.spacetime.free_fall_speed(o.r), gamma = std::sqrt(1 + o.celerity.length2());
  const double rate = o.celerity.x + (is_outgoing(o.tetrad) ? s * gamma : -s * gamma);
  return {rate / std::sqrt(o.spacetime.lapse_squared(o.r)), o.celerity.y, o.celerity.z};
}

}  // namespace domefall
