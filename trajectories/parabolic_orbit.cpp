#include "trajectories/parabolic_orbit.h"

#include <cmath>

#include "trajectories/infinity.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"

namespace domefall {
namespace {

// Here w3 - w2 = q/2 and w2 = (1 - q)/4, with q = sqrt(1 - 16/L^2).
Geodesic parabolic(double angular_momentum, double periastron, double q) {
  return {OrbitCurve::scattered({1, 0, angular_momentum}, periastron, 0, q / 2), 0, -kInfinity};
}

double periastron_of(double angular_momentum, double q) {
  return angular_momentum * angular_momentum * (1 + q) / 4;
}

}  // namespace

Geodesic parabolic_by_periastron(double periastron) {
  require_above("periastron", "units of M", periastron, kParabolicInnermost,
                "what falls from rest at infinity does not come back from there");
  const double angular_momentum = periastron * std::sqrt(2 / (periastron - 2));
  return parabolic(angular_momentum, periastron, (periastron - 4) / periastron);
}

Geodesic parabolic_by_angular_momentum(double angular_momentum) {
  require_above("angular_momentum", "units of M", angular_momentum, kParabolicAngularMomentum,
                "what falls from rest at infinity with less is captured");
  const double l = angular_momentum, q = std::sqrt((l - 4) * (l + 4)) / l;
  return parabolic(l, periastron_of(l, q), q);
}

Geodesic parabolic_by_excess(double excess) {
  require_at_least("excess", "of the angular momentum over 4 M, in parts", excess, kLeastExcess,
                   "the orbit would never leave r = 4");
  const double l = 4 * (1 + excess), q = std::sqrt(excess * (2 + excess)) / (1 + excess);
  return parabolic(l, periastron_of(l, q), q);
}

}  // namespace domefall
