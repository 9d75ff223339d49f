#include "trajectories/given_velocity.h"

#include <cmath>

namespace domefall {

V3d celerity_against(const V3d& frame, const V3d& own) {
  const double gamma = std::sqrt(1 + own.dot(own)), frame_gamma = std::sqrt(1 + frame.dot(frame));
  return own + frame * (gamma + frame.dot(own) / (1 + frame_gamma));
}

OrbitPoint GivenVelocity::at(const ProperTime& /*tau*/) const {
  return {region, tetrad, r, 0, celerity};
}

bool GivenVelocity::is_at_rest(const Spacetime& spacetime) const {
  if (r <= spacetime.horizon()) return false;
  const V3d rest = resting_celerity(spacetime, r, tetrad);
  // A speed of 0 against the static observer comes back rounded from the composition of celerities.
  return (celerity - rest).length() <= 1e-12 * (1 + rest.length());
}

}  // namespace domefall
