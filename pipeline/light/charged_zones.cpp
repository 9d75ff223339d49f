#include "pipeline/light/charged_zones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using Long = long double;

constexpr PolarAngle kAhead{0, std::numbers::pi_v<Long>}, kBehind{std::numbers::pi_v<Long>, 0};

// Returns the least of an edge's angles to the axis either way, to the other critical ray, and 1.
double smallest_angle(const ChargedView& view, const PolarAngle& edge) {
  const Long axis = std::min({Long{1}, edge.angle, edge.rest});
  const Long other = view.circle().exists ? view.between_edges() : 0;
  return static_cast<double>(other > 0 ? std::min(axis, other) : axis);
}

PolarAngle angle_of_tangent(Long tangent) {
  return {2 * std::atan(tangent), 2 * std::atan2(Long{1}, tangent)};
}

class ZoneMaker {
 public:
  explicit ZoneMaker(const ChargedView& view) : view_(view) {}

  // Adds the zones between a critical ray and the axis at alpha = pi (sign 1) or 0 (-1).  Light of
  // the axis comes straight from the sky, or from the core.
  void add_to_axis(Critical critical, double sign, ChargedOrigin sky, int passages, bool core) {
    const PolarAngle edge = angle(critical);
    const auto reach = static_cast<double>(sign > 0 ? edge.rest : edge.angle);
    if (reach == 0) return;
    const auto rate = static_cast<double>(passages / std::sqrt(view_.circle().second));
    add_with_end({view_, sky, ZoneStart::kLogarithm, rate, critical, edge, sign, reach, !core,
                  smallest_angle(view_, edge)});
    if (core) add_core(sign < 0, sky, reach / 2);
  }

  // Adds the zone next to the axis, alpha = 0 or pi, whose light turned at the core.
  void add_core(bool ahead, ChargedOrigin sky, double reach) {
    // On the axis E = f or 1, and b = r alpha/E.  Next to it phi = 2.622 sqrt(b/q) (1 + O(sqrt(b/q^3))).
    const double r = view_.at().r, q = view_.hole().charge, e = axis_energy(ahead);
    constexpr double kLemniscate = 2.622057554292119810;
    const double least = std::min({reach, q * q * q * e / r, e * r / q, std::sqrt(e)});
    zones_.push_back({view_, sky, ZoneStart::kRoot, kLemniscate * std::sqrt(2 * r / (q * e)),
                      Critical::kFirst, ahead ? kAhead : kBehind, ahead ? 1.0 : -1.0, reach, false,
                      least});
  }

  void add_dark(const PolarAngle& from, const PolarAngle& to) {
    const auto reach =
        static_cast<double>(from.angle < from.rest ? to.angle - from.angle : from.rest - to.rest);
    if (reach > 0)
      zones_.push_back({view_, ChargedOrigin::kDark, ZoneStart::kDark, 0, Critical::kFirst, from, 1,
                        reach, false, reach});
  }

  // Adds the three zones of a view without critical rays: two beside the greatest azimuth, one at
  // the core.
  void add_peak() {
    const PolarAngle peak = highest();
    const bool core_ahead = !view_.outgoing();
    const auto to_core = static_cast<double>(core_ahead ? peak.angle : peak.rest);
    const auto to_sky = static_cast<double>(core_ahead ? peak.rest : peak.angle);
    const double sign = core_ahead ? 1 : -1, least = smallest_angle(view_, peak);
    const auto level = [&](double way, double reach, bool axis) {
      add_with_end({view_, ChargedOrigin::kOwn, ZoneStart::kLevel, 0, Critical::kFirst, peak, way,
                    reach, axis, least});
    };
    add_core(core_ahead, ChargedOrigin::kOwn, to_core / 2);
    level(-sign, to_core, false);
    level(sign, to_sky, true);
  }

  PolarAngle angle(Critical edge) const { return angle_of_tangent(view_.tan_half_critical(edge)); }

  std::vector<ChargedZone> zones() {
    const auto low = [](const ChargedZone& zone) {
      return zone.sign > 0 ? zone.edge_angle.angle : zone.edge_angle.angle - zone.reach;
    };
    std::sort(zones_.begin(), zones_.end(),
              [&](const ChargedZone& a, const ChargedZone& b) { return low(a) < low(b); });
    return std::move(zones_);
  }

 private:
  // Returns |E| on the axis, where b = r a/|E| at an angle a from it.
  double axis_energy(bool ahead) const {
    return ahead ? std::abs(static_cast<double>(view_.lapse_squared())) : 1;
  }

  // Returns the angle from the axis up to which light that comes straight from the sky has phi =
  // a/|E|.  There b is so small that no f/r'^2 on its way counts beside 1/b^2; nor does a^2 in E.
  double straight_up_to(bool ahead) const {
    const auto f = static_cast<double>(view_.lapse_squared());
    const double r = view_.at().r, q2 = view_.hole().charge * view_.hole().charge;
    double most = std::abs(f) / (r * r);
    // On the way f/r'^2 is greatest at the circle of light, and least at the inner one.
    const auto pass = [&](double there) {
      if (r < there)
        most = std::max(most, std::abs(1 - (2 - q2 / there) / there) / (there * there));
    };
    if (view_.circle().exists) {
      pass(static_cast<double>(1 / view_.circle().w));
      if (q2 > 0) pass(static_cast<double>(2 * q2 * view_.circle().w));
    }
    const double e = axis_energy(ahead), root = std::sqrt(std::abs(f));
    return std::min(e / (r * std::sqrt(most)), 2 * (ahead ? root : 1 / root));
  }

  // Adds a zone whose other end is the axis.  It goes half of the way where the light of the axis is
  // from the core, and where the azimuth has a form of its own next to it.
  void add_with_end(ChargedZone zone) {
    const bool ahead = zone.sign < 0;
    const double straight = straight_up_to(ahead);
    const bool split = zone.ends_on_axis && straight < zone.reach;
    if (split || !zone.ends_on_axis) zone.reach /= 2;
    zone.ends_on_axis = zone.ends_on_axis && !split;
    zones_.push_back(zone);
    if (!split) return;
    zone.start = ZoneStart::kLine;
    zone.coefficient = 2 / axis_energy(ahead);
    zone.edge_angle = ahead ? kAhead : kBehind;
    zone.sign = -zone.sign;
    zone.smallest_angle = straight;
    zones_.push_back(zone);
  }

  // Returns alpha of the greatest azimuth, which rises from one axis and falls to the other, by
  // golden section in the logarithm of tan(alpha/2).
  PolarAngle highest() const {
    constexpr Long kGolden = std::numbers::phi_v<Long> - 1;
    const auto phi = [&](Long u) {
      return view_.azimuth(view_.ray_at(angle_of_tangent(std::exp(u))));
    };
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

  ChargedView view_;
  std::vector<ChargedZone> zones_;
};

}  // namespace

HalfAngle ChargedZone::edge() const {
  const bool small = edge_angle.angle < edge_angle.rest;
  const Long half = (small ? edge_angle.angle : edge_angle.rest) / 2;
  const auto sine = static_cast<double>(std::sin(half));
  const auto cosine = static_cast<double>(std::cos(half));
  return small ? HalfAngle{sine, cosine} : HalfAngle{cosine, sine};
}

double ChargedZone::x_max() const { return 2 * std::tan(reach / 4); }

ChargedRay ChargedZone::ray(double offset) const {
  const double turn = sign * offset;
  if (start == ZoneStart::kLogarithm) return view.ray_off_edge(critical, turn);
  return view.ray_at({edge_angle.angle + turn, edge_angle.rest - turn});
}

double ChargedZone::azimuth(double offset) const {
  if (ends_on_axis && offset > reach) return -view.azimuth(ray(2 * reach - offset));
  return view.azimuth(ray(offset));
}

std::vector<ChargedZone> charged_zones(const ChargedHole& hole, const ChargedRadius& at,
                                       bool outgoing) {
  const ChargedView view(hole, at, outgoing);
  ZoneMaker maker(view);
  if (!view.has_edges()) {
    maker.add_peak();
    return maker.zones();
  }
  // Light of the own sky, or in T' between the horizons that of the universe before, lies beyond
  // one critical ray.  Light of another sky, or from the core, lies beyond one too.
  const bool between = view.lapse_squared()<0, far = at.above_light_circle> 0;
  const bool swapped = outgoing && !between;
  const Critical own = swapped ? Critical::kSecond : Critical::kFirst;
  const Critical other = far ? own : swapped ? Critical::kFirst : Critical::kSecond;
  const double sign = swapped ? -1 : 1;
  const bool core = hole.charge > 0, within = hole.is_naked() || at.above_inner < 0;
  const ChargedOrigin before = within ? ChargedOrigin::kOwn : ChargedOrigin::kBefore;
  const PolarAngle end = swapped ? kBehind : kAhead;

  const bool own_seen = !between || !outgoing || core,
             other_seen = between ? !outgoing || core : core;
  if (own_seen)
    maker.add_to_axis(own, sign, between && outgoing ? ChargedOrigin::kBefore : ChargedOrigin::kOwn,
                      1, between && outgoing);
  if (other_seen) {
    const ChargedOrigin sky = !between   ? before
                              : outgoing ? ChargedOrigin::kParallelBefore
                                         : ChargedOrigin::kParallel;
    maker.add_to_axis(other, -sign, sky, far ? 2 : 1, !between || outgoing);
  }
  const PolarAngle from = other_seen ? maker.angle(other) : end;
  const PolarAngle to = own_seen ? maker.angle(own) : kBehind;
  swapped ? maker.add_dark(to, from) : maker.add_dark(from, to);
  return maker.zones();
}

}  // namespace domefall
