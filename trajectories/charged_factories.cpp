// Makes orbits near a charge of the terms of shows.
#include <cmath>
#include <stdexcept>

#include "trajectories/charged_orbit.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"
#include "trajectories/short_number.h"
#include "trajectories/wide_turns.h"

namespace domefall {
namespace {

constexpr double kNoEnergy = 1e-14;  // of gamma; what rounding leaves of 0

// ---- the circles that bound what falls into a hole ----

WideConstants circle_constants(const WideSpace& s, const Wide& w) {
  const Wide below = 1 + w * (2 * s.q2 * w - 3), f = s.f(w);
  return {(f * f - below) / below, (1 - s.q2 * w) / (w * below)};
}

Wide light_circle(const WideSpace& s) { return 2 / (3 + sqrt(Wide(9 - 8 * s.q2))); }
Wide last_stable(const WideSpace& s) {
  return roots_of({1, -6, 9 * s.q2, -4 * s.q2 * s.q2}).front();
}

// Returns w of the unstable circle of that energy.
Wide barrier(const WideSpace& s, const Wide& excess) {
  const auto beyond = [&](const Wide& w) {
    return s.f(w) * s.f(w) - (1 + excess) * (1 + w * (2 * s.q2 * w - 3));
  };
  return wide_zero(beyond, last_stable(s), light_circle(s));
}

// Returns w of the unstable circle whose constants let an orbit turn at far(w), too.
template <class Far>
Wide separatrix(const WideSpace& s, const Far& far) {
  // P/(x - w)^2 is n + m x - a x^2.
  const auto at_far = [&](const Wide& w) -> Wide {
    const WideConstants c = circle_constants(s, w);
    const Wide a = s.q2 * c.l2, x = far(w);
    return c.excess / (w * w) + x * (2 * (c.l2 - a * w) - a * x);
  };
  return wide_zero(at_far, last_stable(s), barrier(s, 0));
}

double capture_momentum(const WideSpace& s, const Wide& excess) {
  return static_cast<double>(sqrt(circle_constants(s, barrier(s, excess)).l2));
}

double speed_of_excess(const Wide& excess) {
  return static_cast<double>(sqrt(Wide(excess / (1 + excess))));
}

// ---- bounds ----

void require_momentum(double l) {
  require_at_least("angular_momentum", "units of M", l, 0, "the sense of an orbit is its heading");
}

void require_excess(double excess, const char* of, const char* why) {
  require_at_least("excess", of, excess, kLeastExcess, why);
}

void require_hole(const ChargedHole& hole) {
  if (hole.is_naked())
    throw std::domain_error(
        "excess is for holes: nothing falls into a naked singularity, so that there is no bound to "
        "exceed");
}

// Says whether an L lets something of that energy fall in from afar, or come back.
void require_scattering(const WideSpace& s, double excess, double l, bool comes_back) {
  require_momentum(l);
  if (s.hole.is_naked()) return;
  const double bound = capture_momentum(s, excess), root = std::sqrt(excess);
  const auto check = comes_back ? require_above : require_below;
  if (excess == 0)
    check("angular_momentum", "units of M", l, bound,
          comes_back ? "what falls from rest at infinity with less is captured"
                     : "what falls from rest at infinity with more comes back");
  else
    check("impact_parameter", "units of M", l / root, bound / root,
          "at v_inf = " + short_number(speed_of_excess(excess)) +
              (comes_back ? " what comes closer is captured"
                          : " what passes farther out comes back"));
}

// Checks what comes from infinity and turns at r, or says how fast it must be.
void require_turn(const WideSpace& s, double r, double excess) {
  const ChargedHole& hole = s.hole;
  if (hole.is_naked()) return require_above("periastron", "units of M", r, 0, "it is a radius");
  if (excess == 0)
    return require_above("periastron", "units of M", r, static_cast<double>(1 / barrier(s, 0)),
                         "what falls from rest at infinity does not come back from there");
  require_above("periastron", "units of M", r, hole.light_circle(), "no orbit turns there");
  const Wide least = circle_constants(s, 1 / Wide(r)).excess;
  if (!(least > 0)) return;
  const double bound = speed_of_excess(least);
  require_above("v_inf", "fraction of c", speed_of_excess(excess), bound,
                "to turn at r = " + short_number(r) + " takes more than " +
                    short_number(bound * kLightSpeedKmPerS) + " km/s");
}

WideConstants turning_at(const WideSpace& s, const Wide& w, const Wide& excess) {
  return {excess, ((1 + excess) / s.f(w) - 1) / (w * w)};
}

// Returns the least semilatus rectum of that eccentricity.
Wide least_rectum(const WideSpace& s, const Wide& e) {
  return (1 + e) / separatrix(s, [&](const Wide& w) { return Wide(w * (1 - e) / (1 + e)); });
}

// Returns the orbit between two turning points, which are in their order.
WideTurns turns_of_ends(const WideSpace& s, const Wide& w1, const Wide& w2) {
  if (w1 == w2) return turns_between(s, circle_constants(s, w1), w1, w1);
  const Wide f1 = s.f(w1), f2 = s.f(w2), l2 = (f1 - f2) / (f2 * w2 * w2 - f1 * w1 * w1);
  const WideConstants c{f1 * l2 * w1 * w1 + (f1 - 1), l2};
  if (!(f1 > 0 && f2 > 0 && l2 >= 0))
    throw std::domain_error(
        "periastron must be larger: even without angular momentum an orbit that rises so far turns "
        "farther out");
  if (next_root(radial_polynomial(s, c), w2 * (1 - kRootBeside), false) > w1 * (1 + kRootBeside))
    throw std::domain_error(
        "periastron must be larger: an orbit that rises so far turns before it");
  return turns_between(s, c, w1, w2);
}

}  // namespace

// ---- from infinity and back ----

ChargedOrbit ChargedOrbit::by_periastron(const ChargedHole& hole, double r, double excess_energy) {
  const WideSpace s(hole);
  require_turn(s, r, excess_energy);
  const Wide w = 1 / Wide(r);
  const WideConstants c = turning_at(s, w, excess_energy);
  const WidePolynomial p = radial_polynomial(s, c);
  const Wide outside = w * (1 - kRootBeside);
  if (!(c.l2 >= 0 && value(p, outside) > 0 && next_root(p, outside, false) <= 0))
    throw std::domain_error("periastron is where nothing turns that comes from infinity so, got " +
                            short_number(r));
  return ChargedOrbit(turns_between(s, c, next_root(p, outside, false), w).turns);
}

ChargedOrbit ChargedOrbit::scattered(const ChargedHole& hole, double excess_energy, double l) {
  const WideSpace s(hole);
  require_scattering(s, excess_energy, l, true);
  return ChargedOrbit(turns_about(s, {excess_energy, Wide(l) * l}, 0).turns);
}

ChargedOrbit ChargedOrbit::by_momentum_excess(const ChargedHole& hole, double excess_energy,
                                              double excess) {
  require_hole(hole);
  require_excess(excess,
                 excess_energy == 0 ? "of the angular momentum over its bound, in parts"
                                    : "of the impact parameter over its bound, in parts",
                 "the orbit would never leave its periastron");
  const WideSpace s(hole);
  const Wide more = 1 + Wide(excess),
             l2 = circle_constants(s, barrier(s, excess_energy)).l2 * more * more;
  return ChargedOrbit(turns_about(s, {excess_energy, l2}, 0).turns);
}

ChargedOrbit ChargedOrbit::by_speed_excess(const ChargedHole& hole, double r, double excess) {
  require_hole(hole);
  const WideSpace s(hole);
  require_above("periastron", "units of M", r, hole.light_circle(), "no orbit turns there");
  require_below("periastron", "units of M", r, static_cast<double>(1 / barrier(s, 0)),
                "from there on any speed is enough");
  require_excess(excess, "of the speed over its bound, in parts",
                 "the orbit would never leave its periastron");
  const Wide w = 1 / Wide(r), least = circle_constants(s, w).excess, more = 1 + Wide(excess);
  const Wide v2 = least / (1 + least) * more * more;
  require_below("v_inf", "fraction of c", static_cast<double>(sqrt(v2)), 1,
                "nothing outruns light");
  const WideConstants c = turning_at(s, w, v2 / (1 - v2));
  const Wide outside = w * (1 - kRootBeside);
  return ChargedOrbit(
      turns_between(s, c, next_root(radial_polynomial(s, c), outside, false), w).turns);
}

// ---- bound ----

ChargedOrbit ChargedOrbit::between(const ChargedHole& hole, double periastron, double apoastron) {
  const WideSpace s(hole);
  const Wide w1 = 1 / Wide(apoastron), w2 = 1 / Wide(periastron);
  if (hole.is_naked()) {
    require_above("periastron", "units of M", periastron, 0, "it is a radius");
  } else {
    require_above("apoastron", "units of M", apoastron, static_cast<double>(1 / last_stable(s)),
                  "no stable orbit is smaller");
    require_above(
        "periastron", "units of M", periastron,
        static_cast<double>(1 / separatrix(s, [&](const Wide&) { return Wide(w1); })),
        "below it an orbit that rises to " + short_number(apoastron) + " falls into the hole");
  }
  require_at_least("apoastron", "units of M", apoastron, periastron,
                   "it is the farthest point of the orbit");
  return ChargedOrbit(turns_of_ends(s, w1, w2).turns);
}

ChargedOrbit ChargedOrbit::by_shape(const ChargedHole& hole, double p, double e) {
  require_eccentricity(e);
  const WideSpace s(hole);
  if (!hole.is_naked())
    require_above("p", "units of M", p, static_cast<double>(least_rectum(s, e)),
                  "at e = " + short_number(e) + " a smaller orbit falls into the hole");
  return ChargedOrbit(turns_of_ends(s, (1 - Wide(e)) / p, (1 + Wide(e)) / p).turns);
}

ChargedOrbit ChargedOrbit::by_shape_excess(const ChargedHole& hole, double e, double excess) {
  require_hole(hole);
  require_eccentricity(e);
  require_excess(excess, "of p over its bound, units of M",
                 "the orbit would never leave its periastron");
  const WideSpace s(hole);
  const Wide p = least_rectum(s, e) + excess;
  return ChargedOrbit(turns_of_ends(s, (1 - Wide(e)) / p, (1 + Wide(e)) / p).turns);
}

// ---- falls and throws ----

ChargedOrbit ChargedOrbit::from_rest(const ChargedHole& hole, double r, double l) {
  require_above("rest_r", "units of M", r, hole.horizon(),
                hole.is_naked() ? "it is a radius" : "nothing rests at or inside the horizon");
  require_momentum(l);
  const WideSpace s(hole);
  const Wide w = 1 / Wide(r), f = s.f(w), l2 = Wide(l) * l;
  if (!hole.is_naked() && r > hole.light_circle()) {
    const bool stable = r > hole.last_stable_orbit();
    const Wide top = stable ? separatrix(s, [&](const Wide&) { return Wide(w); }) : w;
    require_below("angular_momentum", "units of M", l,
                  static_cast<double>(sqrt(circle_constants(s, top).l2)),
                  "with more, what starts at r = " + short_number(r) + " does not fall in");
  }
  const WideTurns t = turns_from(s, {f * l2 * w * w + (f - 1), l2}, w);
  return counted_from(t.turns, t.above(w), t.below(w), Leg::kInward);
}

ChargedOrbit ChargedOrbit::falling(const ChargedHole& hole, double r, double excess_energy,
                                   double l) {
  const WideSpace s(hole);
  require_above("from_r", "units of M", r, 0, "it is a radius");
  require_scattering(s, excess_energy, l, false);
  const WideConstants c{excess_energy, Wide(l) * l};
  const WideTurns t = turns_about(s, c, 0);
  require_at_least("from_r", "units of M", r, t.turns.near,
                   "there the charge turns what comes from infinity so");
  const Wide w = 1 / Wide(r);
  return counted_from(t.turns, t.above(w), t.below(w), Leg::kInward);
}

ChargedOrbit ChargedOrbit::thrown(const ChargedHole& hole, double r, double radial,
                                  double tangential) {
  if (!(r < hole.inner_horizon()))
    require_above("r", "units of M", r, hole.horizon(),
                  hole.is_naked() ? "it is a radius"
                                  : "nothing rests at the horizons or between, to throw from");
  const WideSpace s(hole);
  const Wide w = 1 / Wide(r), f = s.f(w), u2 = Wide(radial) * radial, l = Wide(r) * tangential;
  const WideConstants c{f * (u2 + Wide(tangential) * tangential) + (f - 1), l * l};
  const WideTurns t = radial == 0 ? turns_from(s, c, w) : turns_about(s, c, w);
  return counted_from(t.turns, t.above(w), t.below(w), radial > 0 ? Leg::kOutward : Leg::kInward);
}

ChargedOrbit ChargedOrbit::thrown_from_tetrad(const ChargedHole& hole, double r, double radial,
                                              double tangential) {
  require_above("r", "units of M", r, 0, "it is a radius");
  const WideSpace s(hole);
  const Wide w = 1 / Wide(r), f = s.f(w), l = Wide(r) * tangential;
  const Wide gamma = sqrt(Wide(1 + Wide(radial) * radial + Wide(tangential) * tangential));
  const Wide energy = (1 + f) / 2 * gamma - (1 - f) / 2 * radial,
             rate = (1 + f) / 2 * radial - (1 - f) / 2 * gamma;
  if (abs(energy) < kNoEnergy * gamma)
    throw std::domain_error(
        "speed leads through the crossing of the inner horizons, where no tetrad is regular; "
        "change it a little");
  const WideConstants c{energy * energy - 1, l * l};
  const WideTurns t = turns_about(s, c, w);
  return counted_from(t.turns, t.above(w), t.below(w), rate > 0 ? Leg::kOutward : Leg::kInward);
}

bool ChargedOrbit::has_negative_energy(const ChargedHole& hole, double r, double radial,
                                       double tangential) {
  const StaticTime time = hole.static_time(r);
  const double gamma = std::hypot(1, radial, tangential);
  return time.along_t * gamma - time.along_r * radial < 0;
}

ChargedOrbit ChargedOrbit::off_circle(const ChargedHole& hole, double circle, double over,
                                      double more) {
  const WideSpace s(hole);
  const Wide wc = 1 / Wide(circle), w = wc + over;
  WideConstants c = circle_constants(s, wc);
  c.excess += more;
  const WideTurns t = turns_about(s, c, w);
  return counted_from(t.turns, t.above(w), t.below(w), Leg::kInward);
}

}  // namespace domefall
