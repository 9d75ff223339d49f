#include "trajectories/trajectory.h"

#include <cmath>
#include <type_traits>

namespace domefall {

OrbitPoint point_at(const Trajectory& trajectory, const ProperTime& tau) {
  return std::visit(
      [&tau](const auto& kind) {
        using Motion = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Motion, Geodesic> || std::is_same_v<Motion, RadialInfall>)
          return point_at(kind, tau);
        else
          return point_at(kind, double(tau));
      },
      trajectory);
}

double lifetime(const Trajectory& trajectory) {
  if (const auto* geodesic = std::get_if<Geodesic>(&trajectory)) return geodesic->death();
  // The last instant of a path still belongs to it.
  if (const auto* path = std::get_if<AcceleratedPath>(&trajectory))
    return std::nextafter(path->end(), std::numeric_limits<double>::infinity());
  const auto* fall = std::get_if<RadialInfall>(&trajectory);
  return fall ? time_to_singularity(*fall) : std::numeric_limits<double>::infinity();
}

}  // namespace domefall
