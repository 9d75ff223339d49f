#include "trajectories/passages.h"

#include <algorithm>
#include <cmath>

namespace domefall {
namespace {

// This is true for what stays at its radius.
template <class Motion>
constexpr bool kStays =
    std::is_same_v<Motion, StaticObserver> || std::is_same_v<Motion, CircularOrbit> ||
    std::is_same_v<Motion, GivenVelocity> || std::is_same_v<Motion, SpeedRamp>;

// Returns the least and the largest r, to a few parts in 1e5 of the path's extent.
std::pair<double, double> reach_of(const AcceleratedPath& path) {
  constexpr int kSteps = 1000;
  double low = path.at(path.begin()).r, high = low;
  for (int k = 0; k <= kSteps; ++k) {
    const double r =
        path.at(std::lerp(path.begin(), path.end(), static_cast<double>(k) / kSteps)).r;
    low = std::min(low, r), high = std::max(high, r);
  }
  return {low, high};
}

}  // namespace

double birth(const Trajectory& trajectory) {
  const auto* geodesic = std::get_if<Geodesic>(&trajectory);
  if (geodesic) return geodesic->birth();
  const double before_all = -std::numeric_limits<double>::infinity();
  const auto* path = std::get_if<AcceleratedPath>(&trajectory);
  return path ? std::nextafter(path->begin(), before_all) : before_all;
}

std::optional<ProperTime> time_at(const Trajectory& trajectory, double r, Leg leg,
                                  const ProperTime& after) {
  return std::visit(
      [&](const auto& kind) -> std::optional<ProperTime> {
        using Motion = std::decay_t<decltype(kind)>;
        if constexpr (kStays<Motion>) {
          return std::nullopt;
        } else if constexpr (std::is_same_v<Motion, RadialInfall>) {
          if (leg == Leg::kOutward || r > kind.from_r) return std::nullopt;
          const ProperTime tau = proper_time_to(kind, r);
          return tau >= after ? std::optional(tau) : std::nullopt;
        } else if constexpr (std::is_same_v<Motion, AcceleratedPath>) {
          return kind.time_at(r, leg, double(after));
        } else {
          return kind.time_at(r, leg, after);
        }
      },
      trajectory);
}

std::pair<double, double> reach(const Trajectory& trajectory) {
  return std::visit(
      [](const auto& kind) -> std::pair<double, double> {
        using Motion = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Motion, SpeedRamp>)
          return {kind.frame.r, kind.frame.r};
        else if constexpr (kStays<Motion>)
          return {kind.r, kind.r};
        else if constexpr (std::is_same_v<Motion, RadialInfall>)
          return {0, kind.from_r};
        else if constexpr (std::is_same_v<Motion, AcceleratedPath>)
          return reach_of(kind);
        else
          return {kind.innermost(), kind.outermost()};
      },
      trajectory);
}

}  // namespace domefall
