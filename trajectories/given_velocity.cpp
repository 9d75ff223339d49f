#include "trajectories/given_velocity.h"

#include <cmath>

namespace domefall {

V3d celerity_against(const V3d& frame, double speed, const V3d& direction) {
  // (1 - v)(1 + v), not 1 - v^2: a speed of 1 - 1e-12 keeps its digits.
  const double gamma = 1 / std::sqrt((1 - speed) * (1 + speed));
  const V3d own = direction * (gamma * speed);
  const double frame_gamma = std::sqrt(1 + frame.dot(frame));
  return own + frame * (gamma + frame.dot(own) / (1 + frame_gamma));
}

OrbitPoint point_at(const GivenVelocity& observer, double /*tau*/) {
  return {observer.r > 2 ? Region::kI : Region::kII, observer.r, 0, observer.celerity};
}

}  // namespace domefall
