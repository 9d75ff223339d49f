#include "trajectories/trajectory.h"

#include <cmath>

namespace domefall {

OrbitPoint point_at(const Trajectory& trajectory, double tau) {
  return std::visit([tau](const auto& kind) { return point_at(kind, tau); }, trajectory);
}

double lifetime(const Trajectory& trajectory) {
  if (const auto* geodesic = std::get_if<Geodesic>(&trajectory)) return geodesic->death();
  // Its last instant belongs to it.
  if (const auto* path = std::get_if<AcceleratedPath>(&trajectory))
    return std::nextafter(path->end(), std::numeric_limits<double>::infinity());
  const auto* fall = std::get_if<RadialInfall>(&trajectory);
  return fall ? proper_time_to(*fall, 0) : std::numeric_limits<double>::infinity();
}

}  // namespace domefall
