#include "trajectories/given_velocity.h"

#include <cmath>

namespace domefall {

V3d celerity_against(const V3d& frame, const V3d& own) {
  const double gamma = std::sqrt(1 + own.dot(own)), frame_gamma = std::sqrt(1 + frame.dot(frame));
  return own + frame * (gamma + frame.dot(own) / (1 + frame_gamma));
}

OrbitPoint point_at(const GivenVelocity& observer, double /*tau*/) {
  return {observer.region, observer.tetrad, observer.r, 0, observer.celerity};
}

}  // namespace domefall
