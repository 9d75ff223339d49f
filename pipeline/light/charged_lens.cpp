#include "pipeline/light/charged_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace domefall {
namespace {

using Long = long double;
using RayAt = std::function<ChargedRay(double)>;

constexpr Long kHalfTurn = std::numbers::pi_v<Long>;
// 1 + z of all light counts as this at least.
constexpr double kLeastEnergy = 1e-9;
// The distance from a horizon, in M, that stands for none.
constexpr double kOnHorizon = 1e-30;
// Two critical rays that are closer than this, as a part of the smallest other angle, count as this
// far apart.
constexpr double kLeastApart = 1e-8;

// In T light has the energy sin^2(alpha/2) + f cos^2(alpha/2).
ViewEnergy energy_of(const ChargedView& view) {
  return {1, static_cast<double>(view.lapse_squared()), kLeastEnergy};
}

ChargedRadius place_of(const ChargedHole& hole, const ObserverState& observer) {
  using enum ChargedMark;
  const ChargedRadius at = hole.at(observer.r);
  if (hole.is_naked()) return at;
  switch (observer.region) {
    case Region::kII:
    case Region::kIV:
      if (!(at.above_outer < 0)) return hole.at(kOuterHorizon, -kOnHorizon);
      return at.above_inner > 0 ? at : hole.at(kInnerHorizon, kOnHorizon);
    case Region::kV:
    case Region::kVI:
      return at.above_inner < 0 ? at : hole.at(kInnerHorizon, -kOnHorizon);
    default:
      return at.above_outer > 0 ? at : hole.at(kOuterHorizon, kOnHorizon);
  }
}

// ---- zones ----

// Returns a zone whose rays are given by their offset from its edge.
SkyZone zone_of(const ChargedView& view, double sign, const RayAt& ray_at) {
  SkyZone zone;
  zone.edge.sign = sign;
  zone.uneven = true;
  const ViewEnergy energy = zone.energy = energy_of(view);
  zone.inward = view.outgoing() ? -1 : 1;
  zone.azimuth = [=](double offset) { return view.azimuth(ray_at(offset)); };
  zone.ray = [=](double offset) {
    const ChargedRay ray = ray_at(offset);
    return ZoneRay{{static_cast<double>(ray.sin_half), static_cast<double>(ray.cos_half)},
                   energy.one_plus_z(static_cast<double>(view.energy(ray)))};
  };
  return zone;
}

// Returns how much smaller than other angles the one is within which a logarithm holds.  Where q^2
// comes close to 9/8 it vanishes.
double logarithmic_part(const ChargedView& view) {
  const auto a = static_cast<double>(view.circle().second);
  return std::min(1.0, 8 * a * a * a);
}

// Returns the smallest angle on which azimuths have structure next to a critical ray: that to the
// axis either way, to the other critical ray, or 1.
double smallest_angle(const ChargedView& view, double tangent, double other) {
  const double axis = 2 * std::atan(std::min(tangent, 1 / tangent));
  const double apart = std::abs(tangent - other);
  const auto between = static_cast<double>(view.between_edges());
  return std::min({1.0, axis, apart > 0 ? std::max(apart, kLeastApart) : 1.0,
                   std::max(between, kLeastApart * axis)}) *
         std::max(logarithmic_part(view), kLeastApart);
}

// Returns the zone beyond a critical ray, towards alpha = pi (sign 1) or 0 (-1).  Its light passes
// the circle of light so many times.
SkyZone beyond(const ChargedView& view, Critical edge, double sign, int passages) {
  const auto tangent = static_cast<double>(view.tan_half_critical(edge));
  const auto other = static_cast<double>(
      view.tan_half_critical(edge == Critical::kFirst ? Critical::kSecond : Critical::kFirst));
  SkyZone zone =
      zone_of(view, sign, [=](double offset) { return view.ray_off_edge(edge, sign * offset); });
  zone.edge.half = half_angle_of_tangent(tangent);
  zone.reach = sign > 0 ? 2 * std::atan2(1.0, tangent) : 2 * std::atan(tangent);
  zone.least = smallest_angle(view, tangent, other);
  zone.logarithm = logarithmic_part(view) > kLeastApart
                       ? passages / std::sqrt(static_cast<double>(view.circle().second))
                       : 0;
  return zone;
}

PolarAngle angle_of_tangent(Long tangent) {
  return {2 * std::atan(tangent), 2 * std::atan2(Long{1}, tangent)};
}

// Returns alpha of the greatest azimuth, which rises from one axis and falls to the other, by golden
// section in the logarithm of tan(alpha/2).
PolarAngle highest(const ChargedView& view) {
  constexpr Long kGolden = std::numbers::phi_v<Long> - 1;
  const auto phi = [&](Long u) { return view.azimuth(view.ray_at(angle_of_tangent(std::exp(u)))); };
  Long low = -60, high = 60, a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = phi(a), at_b = phi(b);
  for (int k = 0; k < 110; ++k) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = phi(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = phi(b);
    }
  }
  return angle_of_tangent(std::exp((low + high) / 2));
}

// Returns the angle from the peak within which the azimuth falls by a tenth of a radian, or by a
// tenth of itself.
double width_of(const SkyZone& zone) {
  const double peak = zone.azimuth(0), wanted = peak - std::min(0.1, peak / 10);
  double low = std::log(zone.reach) - 80, high = std::log(zone.reach);
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    (zone.azimuth(std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(low);
}

SkyZone beside_peak(const ChargedView& view, const PolarAngle& peak, double sign) {
  SkyZone zone = zone_of(view, sign, [=](double offset) {
    return view.ray_at({peak.angle + sign * offset, peak.rest - sign * offset});
  });
  const Long tangent = std::tan(std::min(peak.angle, peak.rest) / 2);
  zone.edge.half =
      half_angle_of_tangent(static_cast<double>(peak.angle < peak.rest ? tangent : 1 / tangent));
  zone.reach = static_cast<double>(sign > 0 ? peak.rest : peak.angle);
  zone.edge.width = width_of(zone);
  zone.least =
      std::min({1.0, static_cast<double>(std::min(peak.angle, peak.rest)), zone.edge.width});
  zone.logarithm = 0;
  zone.level = true;
  return zone;
}

// ---- far ends ----

// Returns |E| on the axis, where b = r a/|E| at an angle a from it.
double axis_energy(const ChargedView& view, bool ahead) {
  return ahead ? std::abs(static_cast<double>(view.lapse_squared())) : 1;
}

// Returns the angle from the axis up to which light that comes straight from the sky has phi =
// a/|E|.  There b is so small that no f/r'^2 on its way counts beside 1/b^2; nor does a^2 in E.
double straight_up_to(const ChargedView& view, bool ahead) {
  const auto f = static_cast<double>(view.lapse_squared());
  const double r = view.at().r, q2 = view.hole().charge * view.hole().charge;
  double most = std::abs(f) / (r * r);
  // On the way f/r'^2 is greatest at the circle of light, and least at the inner one.
  const auto pass = [&](double there) {
    if (r < there) most = std::max(most, std::abs(1 - (2 - q2 / there) / there) / (there * there));
  };
  if (view.circle().exists) {
    pass(static_cast<double>(1 / view.circle().w));
    pass(static_cast<double>(2 * q2 * view.circle().w));
  }
  const double e = axis_energy(view, ahead), root = std::sqrt(std::abs(f));
  return std::min(e / (r * std::sqrt(most)), 2 * (ahead ? root : 1 / root));
}

// Returns the angle from the axis up to which light that turned at the core has phi = 2.622
// sqrt(b/q), which holds for b << q^3.
double core_up_to(const ChargedView& view, bool ahead) {
  constexpr double kLeast = 1e-30;
  const double r = view.at().r, q = view.hole().charge, e = axis_energy(view, ahead);
  return std::max(kLeast * std::min(1.0, e),
                  std::min({q * q * q * e / r, e * r / q, std::sqrt(e)}));
}

// Gives a zone's far end a form of its own.
SkyZone with_end(SkyZone zone, const ChargedView& view, bool core) {
  const bool ahead = zone.edge.sign < 0;
  const double least = core ? core_up_to(view, ahead) : straight_up_to(view, ahead);
  zone.end =
      ZoneEnd{std::min(zone.reach, least), core, [=](double off) {
                const PolarAngle away{off, kHalfTurn - off};
                return view.azimuth(view.ray_at(ahead ? away : PolarAngle{away.rest, away.angle}));
              }};
  return zone;
}

// ---- what is seen ----

struct SeenZone {
  ChargedOrigin origin;
  SkyZone zone;
};

// Without critical rays the own sky is seen on both sides of the greatest azimuth.
std::vector<SeenZone> zones_without_edges(const ChargedView& view) {
  const PolarAngle peak = highest(view);
  const double to_sky = view.outgoing() ? -1 : 1;
  return {{ChargedOrigin::kOwn, with_end(beside_peak(view, peak, to_sky), view, false)},
          {ChargedOrigin::kOwn, with_end(beside_peak(view, peak, -to_sky), view, true)}};
}

// Light of the own sky, or in T' between the horizons that of the universe before, lies beyond one
// critical ray.  Light of another sky, or from the core, lies beyond one too.
std::vector<SeenZone> zones_with_edges(const ChargedView& view) {
  const ChargedHole& hole = view.hole();
  const bool between = view.lapse_squared()<0, far = view.at().above_light_circle> 0;
  const bool within = hole.is_naked() || view.at().above_inner < 0, rising = view.outgoing();
  const bool swapped = rising && !between, charged = hole.charge > 0;
  const Critical own = swapped ? Critical::kSecond : Critical::kFirst;
  const Critical other = far ? own : swapped ? Critical::kFirst : Critical::kSecond;
  const double sign = swapped ? -1 : 1;
  std::vector<SeenZone> seen;
  if (between && rising) {
    if (charged)
      seen = {
          {ChargedOrigin::kBefore, with_end(beyond(view, own, sign, 1), view, true)},
          {ChargedOrigin::kParallelBefore, with_end(beyond(view, other, -sign, 1), view, true)}};
    return seen;
  }
  const SkyZone direct = beyond(view, own, sign, 1);
  seen.push_back({ChargedOrigin::kOwn, within ? with_end(direct, view, false) : direct});
  if (between) {
    seen.push_back({ChargedOrigin::kParallel, beyond(view, other, -sign, 1)});
  } else if (charged) {
    seen.push_back({within ? ChargedOrigin::kOwn : ChargedOrigin::kBefore,
                    with_end(beyond(view, other, -sign, far ? 2 : 1), view, true)});
  }
  return seen;
}

}  // namespace

std::optional<SkyRegion> sky_of(ChargedOrigin origin, const ObserverState& observer) {
  const bool before = origin == ChargedOrigin::kBefore || origin == ChargedOrigin::kParallelBefore;
  const bool parallel =
      origin == ChargedOrigin::kParallel || origin == ChargedOrigin::kParallelBefore;
  const int universe = observer.universe - (before ? 1 : 0);
  if (origin == ChargedOrigin::kDark || universe < 0) return std::nullopt;
  return own_sky(parallel ? mirror_of(observer.tetrad) : observer.tetrad, universe);
}

HoleOptics make_charged_optics(const ChargedHole& hole, const ObserverState& observer) {
  const ChargedView view(hole, place_of(hole, observer), is_outgoing(observer.tetrad));
  HoleOptics optics;
  optics.tetrad = observer.tetrad;
  optics.energy = energy_of(view);
  optics.inward = view.outgoing() ? -1 : 1;
  for (auto& [origin, zone] : view.has_edges() ? zones_with_edges(view) : zones_without_edges(view))
    if (const auto sky = sky_of(origin, observer))
      optics.parts.push_back({*sky, std::move(zone), {}});
  return optics;
}

}  // namespace domefall
