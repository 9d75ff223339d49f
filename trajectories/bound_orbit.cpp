#include "trajectories/bound_orbit.h"

#include <cmath>
#include <limits>

#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

// Here w3 - w2 = (p - 6 - 2e)/(2p) and E^2 - 1 = -(1 - e^2)(p - 4)/(p (p - 3 - e^2)).
Geodesic bound_orbit(double periastron, double apoastron, double p, double e, double excess) {
  const double below = p - 3 - e * e;
  const double excess_energy = -(1 - e) * (1 + e) * (p - 4) / (p * below);
  const OrbitConstants constants{std::sqrt(((p - 2) - 2 * e) * ((p - 2) + 2 * e) / (p * below)),
                                 excess_energy, p / std::sqrt(below)};
  return {OrbitCurve::bound(constants, periastron, apoastron, excess / (2 * p)), 0,
          -std::numeric_limits<double>::infinity()};
}

}  // namespace

// p > 6 + 2e means r_p (r_a - 2) > 4 r_a, since p - 6 - 2e = 2 (r_p (r_a - 2) - 4 r_a)/(r_p + r_a).
Geodesic bound_by_turning_points(double periastron, double apoastron) {
  const double a = apoastron, least = 4 * a / (a - 2);
  require_above("apoastron", "units of M", apoastron, 6, "no stable orbit is smaller");
  require_above("periastron", "units of M", periastron, least,
                "below it an orbit that rises to " + short_number(a) + " falls into the hole");
  require_at_least("apoastron", "units of M", apoastron, periastron,
                   "it is the farthest point of the orbit");
  const double sum = periastron + a, p = 2 * periastron * a / sum, e = (a - periastron) / sum;
  // The excess is that difference with r_p (r_a - 2) - 4 r_a = (r_p - 4)(r_a - 2) - 8.
  return bound_orbit(periastron, a, p, e, 2 * ((periastron - 4) * (a - 2) - 8) / sum);
}

Geodesic bound_by_shape(double p, double e) {
  require_eccentricity(e);
  require_above("p", "units of M", p, 6 + 2 * e,
                "at e = " + short_number(e) + " a smaller orbit falls into the hole (p > 6 + 2e)");
  return bound_orbit(p / (1 + e), p / (1 - e), p, e, (p - 6) - 2 * e);
}

Geodesic bound_by_excess(double e, double excess) {
  require_eccentricity(e);
  require_at_least("excess", "p - 6 - 2e, units of M", excess, kLeastExcess,
                   "the orbit would never leave its periastron");
  const double p = 6 + 2 * e + excess;
  return bound_orbit(p / (1 + e), p / (1 - e), p, e, excess);
}

}  // namespace domefall
