#include "pipeline/light/schwarzschild_zone.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// Returns the smallest angle, which is that from the edge to the axis either way, between the two
// critical rays, or 1.  At r = 3 those are one.  It is no smaller than what matters only where the
// light circle is nearer to the observer than 1e-8.
double smallest_angle(const Radius& at, double tangent) {
  constexpr double kLeast = 1e-8;
  const double to_axis = 2 * std::atan(std::min(tangent, 1 / tangent));
  const double apart =
      std::abs(tan_half_critical(at, Critical::kFirst) - tan_half_critical(at, Critical::kSecond));
  return std::min({1.0, to_axis, apart > 0 ? std::max(apart, kLeast) : 1.0});
}

}  // namespace

SkyZone schwarzschild_zone(const Radius& at, Critical edge, bool outgoing) {
  const double tangent = tan_half_critical(at, edge);
  const double sign = edge == Critical::kFirst ? 1 : -1;
  const auto ray_at = [=](double offset) {
    return ray_off_edge(at, edge, sign * offset, {outgoing, false});
  };
  SkyZone zone;
  zone.edge = {half_angle_of_tangent(tangent), sign};
  // pi - edge is 2 acot(tangent), which is no difference of close numbers when the edge is near pi.
  zone.reach = sign > 0 ? 2 * std::atan2(1.0, tangent) : 2 * std::atan(tangent);
  zone.least = smallest_angle(at, tangent);
  // In the outgoing frame E = 0, a branch point of phi, comes close in the complex plane.
  zone.uneven = outgoing;
  // 1 + z is |1 - s cos(alpha)|, with s = sqrt(2/r).
  zone.energy = {1 + Schwarzschild::free_fall_speed(at.r), Schwarzschild::below_light_speed(at)};
  zone.inward = outgoing ? -1 : 1;
  zone.azimuth = [=](double offset) { return exact_azimuth(ray_at(offset)); };
  zone.ray = [=](double offset) {
    const NullRay ray = ray_at(offset);
    return ZoneRay{{ray.sin_half, ray.cos_half}, one_plus_z(ray)};
  };
  return zone;
}

double distance_of(const SkyZone& zone, const NullRay& ray) {
  const double gap = zone.edge.sign > 0 ? ray.gap_first : ray.gap_second;
  const double cosine = ray.cos_half * zone.edge.half.cosine + ray.sin_half * zone.edge.half.sine;
  return 2 * zone.edge.sign * gap * zone.edge.half.cosine / (1 + cosine);
}

}  // namespace domefall
