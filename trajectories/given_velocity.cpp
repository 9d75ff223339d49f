#include "trajectories/given_velocity.h"

namespace domefall {

OrbitPoint GivenVelocity::at(const ProperTime& /*tau*/) const {
  OrbitPoint point{region, tetrad, r, 0, celerity};
  point.l = l, point.theta = theta;
  return point;
}

bool GivenVelocity::is_at_rest(const Spacetime& spacetime) const {
  if (r <= spacetime.horizon()) return false;
  // Who has no angular momentum still turns with a hole that spins.
  if (spacetime.is<SpinningHole>()) return false;
  const V3d rest = resting_celerity(spacetime, r, tetrad);
  // A speed of 0 against the static observer comes back rounded from the composition of celerities.
  return (celerity - rest).length() <= 1e-12 * (1 + rest.length());
}

}  // namespace domefall
