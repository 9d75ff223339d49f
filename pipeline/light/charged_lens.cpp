#include "pipeline/light/charged_lens.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/charged_azimuth.h"

namespace domefall {
namespace {

SkyZone zone_of(const ChargedView& view, Critical edge) {
  const auto tangent = static_cast<double>(view.tan_half_critical(edge));
  const double sign = edge == Critical::kFirst ? 1 : -1;
  const auto f = static_cast<double>(view.lapse_squared());
  SkyZone zone;
  zone.edge = {half_angle_of_tangent(tangent), sign};
  zone.reach = sign > 0 ? 2 * std::atan2(1.0, tangent) : 2 * std::atan(tangent);
  const auto other =
      static_cast<double>(view.tan_half_critical(sign > 0 ? Critical::kSecond : Critical::kFirst));
  const double apart = std::abs(tangent - other);
  zone.least = std::min({1.0, 2 * std::atan(std::min(tangent, 1 / tangent)),
                         apart > 0 ? std::max(apart, 1e-8) : 1.0});
  zone.logarithm = 1 / std::sqrt(static_cast<double>(view.circle().second));
  zone.uneven = true;
  zone.energy = {1, f};
  zone.inward = view.outgoing() ? -1 : 1;
  zone.azimuth = [=](double offset) {
    return view.azimuth(view.ray_off_edge(edge, sign * offset));
  };
  zone.ray = [=](double offset) {
    const ChargedRay ray = view.ray_off_edge(edge, sign * offset);
    return ZoneRay{{static_cast<double>(ray.sin_half), static_cast<double>(ray.cos_half)},
                   static_cast<double>(std::abs(view.energy(ray)))};
  };
  return zone;
}

}  // namespace

HoleOptics make_charged_optics(const ChargedHole& hole, const ObserverState& observer) {
  const bool outgoing = is_outgoing(observer.tetrad);
  const ChargedView view(hole, hole.at(observer.r), outgoing);
  HoleOptics optics;
  optics.tetrad = observer.tetrad;
  optics.energy = {1, static_cast<double>(view.lapse_squared())};
  optics.inward = outgoing ? -1 : 1;
  const bool outside = observer.r > hole.horizon();
  if (outside || !outgoing)
    optics.parts.push_back(
        {own_sky(observer), zone_of(view, outgoing ? Critical::kSecond : Critical::kFirst), {}});
  if (!outside && !outgoing)
    optics.parts.push_back({own_sky(mirror_of(observer.tetrad), observer.universe),
                            zone_of(view, Critical::kSecond),
                            {}});
  return optics;
}

}  // namespace domefall
