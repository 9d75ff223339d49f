#include "trajectories/kruskal_crossing.h"

#include <limits>

#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"

namespace domefall {
namespace {

constexpr double kLeastEnergy = 1e-6;

}  // namespace

Geodesic kruskal_crossing(double energy, double angular_momentum) {
  require_at_least("energy", "of the unit of mass", energy, 0, "mirrored, it is as much");
  if (energy != 0)
    require_at_least("energy", "of the unit of mass", energy, kLeastEnergy,
                     "closer to 0 it is 0 in double precision");
  require_at_least("angular_momentum", "units of M", angular_momentum, 0, "it is a size");
  const OrbitConstants constants{energy, (energy - 1) * (energy + 1), angular_momentum};
  const OrbitStart start = orbit_through(constants, 2, energy);
  if (start.curve.kind() == OrbitCurve::Kind::kReturning) return {start.curve, 0, 0};
  return {start.curve, start.parameter, std::numeric_limits<double>::infinity()};
}

}  // namespace domefall
