// Finds the turning points of orbits near a charge with 50 digits, in which roots that are close to
// each other stay apart.
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "trajectories/charged_orbit.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
using WidePolynomial = std::vector<Wide>;  // coefficients of rising powers

// Other roots that are as close to a turning point as this part of it are not told from it.
const Wide kRootBeside("1e-23");
// Roots that are as close to each other as this part of them may be complex, or not.
constexpr double kBlur = 1e-12;
constexpr double kNoEnergy = 1e-14;  // of gamma; what rounding leaves of 0

Wide value(const WidePolynomial& p, const Wide& x) {
  Wide sum = 0;
  for (std::size_t k = p.size(); k > 0; --k) sum = sum * x + p[k - 1];
  return sum;
}

template <class Function>
Wide wide_zero(const Function& f, const Wide& low, const Wide& high) {
  const Wide at_low = f(low), at_high = f(high);
  if (at_low == 0 || (at_low > 0) == (at_high > 0)) return low;
  constexpr int kBits = 160;
  std::uintmax_t steps = 1000;
  const auto found = boost::math::tools::toms748_solve(
      f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<Wide>(kBits), steps);
  return (found.first + found.second) / 2;
}

// Returns the real roots in their order.  Between two roots of its derivative a polynomial has one
// root at most.  Double roots may be missed, or given once.
std::vector<Wide> roots_of(WidePolynomial p) {
  while (p.size() > 1 && p.back() == 0) p.pop_back();
  std::vector<Wide> roots;
  if (p.size() > 1 && p.front() == 0) {
    roots = roots_of({p.begin() + 1, p.end()});
    roots.insert(std::upper_bound(roots.begin(), roots.end(), Wide(0)), Wide(0));
    return roots;
  }
  if (p.size() < 2) return roots;
  WidePolynomial slope;
  Wide largest = 0;
  for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(p[k] * static_cast<int>(k));
  for (const Wide& c : p) largest = std::max(largest, Wide(abs(c / p.back())));
  std::vector<Wide> ends = roots_of(slope);
  ends.insert(ends.begin(), -1 - largest);
  ends.push_back(1 + largest);
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const Wide low = value(p, ends[k - 1]), high = value(p, ends[k]);
    if (high == 0) roots.push_back(ends[k]);
    if ((low < 0 && high > 0) || (low > 0 && high < 0))
      roots.push_back(wide_zero([&p](const Wide& x) { return value(p, x); }, ends[k - 1], ends[k]));
  }
  return roots;
}

// Returns p/(w - root), whose remainder is left out.
WidePolynomial divided(const WidePolynomial& p, const Wide& root) {
  WidePolynomial quotient(p.size() - 1);
  Wide sum = 0;
  for (std::size_t k = p.size() - 1; k > 0; --k) quotient[k - 1] = sum = p[k] + root * sum;
  return quotient;
}

// A Space holds q^2 and what follows from it.
struct Space {
  ChargedHole hole;
  Wide q2;

  explicit Space(const ChargedHole& of) : hole(of) {
    const Wide q(of.charge_long());
    q2 = q * q;
  }
  Wide f(const Wide& w) const { return 1 + w * (q2 * w - 2); }
};

struct Constants {
  Wide excess, l2;  // E^2 - 1, L^2
};

WidePolynomial radial_polynomial(const Space& s, const Constants& c) {
  return {c.excess, 2, -(s.q2 + c.l2), 2 * c.l2, -s.q2 * c.l2};
}

// ---- turning points ----

// Holds the turning points with their 50 digits, too.
struct WideTurns {
  ChargedTurns turns;
  Wide w1, w2;

  double above(const Wide& w) const { return static_cast<double>(1 / w - 1 / w2); }
  double below(const Wide& w) const {
    return w1 > 0 ? static_cast<double>(1 / w1 - 1 / w) : kInfinity;
  }
};

ChargedTurns narrowed(const Space& s, const Constants& c, const Wide& w1, const Wide& w2) {
  ChargedTurns t{};
  t.hole = s.hole;
  t.energy = static_cast<double>(sqrt(Wide(1 + c.excess)));
  t.l = static_cast<double>(sqrt(c.l2));
  t.near = static_cast<double>(1 / w2);
  t.far = w1 > 0 ? static_cast<double>(1 / w1) : kInfinity;
  t.width = w1 > 0 ? static_cast<double>(1 / w1 - 1 / w2) : kInfinity;
  t.w1 = static_cast<double>(w1);
  const Wide a = s.q2 * c.l2;
  t.a = static_cast<double>(a);
  t.others = ChargedTurns::Others::kComplex;
  // Without L the rest is q^2.
  t.lead = static_cast<double>(s.q2);
  if (a == 0) return t;
  const WidePolynomial rest = divided(divided(radial_polynomial(s, c), w1), w2);
  const Wide middle = -rest[1] / (2 * rest[2]), under = middle * middle - rest[0] / rest[2];
  const Wide apart = sqrt(abs(under));
  // A double root within the orbit may come out as two, and one at its end as one beside it.
  const Wide blur = abs(middle) * kBlur;
  const bool inside = middle > w2 - blur, beyond = middle < w1 + blur;
  if ((under < 0 || apart < blur) && !(apart < blur && (inside || beyond))) {
    const Wide least = middle * middle * kLeastExcess;
    t.middle = static_cast<double>(middle);
    t.lead = static_cast<double>(a * std::max(Wide(-under), least));
    return t;
  }
  const Wide low = middle - apart, high = middle + apart, least = w2 * kLeastExcess;
  const Wide gap = std::max(inside ? Wide(low - w2) : Wide(w1 - high), least);
  t.others = inside ? ChargedTurns::Others::kInside : ChargedTurns::Others::kBeyond;
  t.gap = static_cast<double>(gap);
  t.lead = static_cast<double>(a * std::max(inside ? Wide(high - w2) : Wide(w1 - low), gap));
  return t;
}

WideTurns turns_between(const Space& s, const Constants& c, const Wide& w1, const Wide& w2) {
  return {narrowed(s, c, w1, w2), w1, w2};
}

// Returns the root next to w, above it or below.
Wide next_root(const WidePolynomial& p, const Wide& w, bool above) {
  const std::vector<Wide> roots = roots_of(p);
  const auto after = std::upper_bound(roots.begin(), roots.end(), w);
  if (above ? after == roots.end() : after == roots.begin())
    throw std::domain_error("r is where such an orbit cannot turn");
  return above ? *after : *(after - 1);
}

// Returns the turning points on both sides of a place where the orbit moves.
WideTurns turns_about(const Space& s, const Constants& c, const Wide& w) {
  const WidePolynomial p = radial_polynomial(s, c);
  return turns_between(s, c, next_root(p, w, false), next_root(p, w, true));
}

// Returns those of an orbit that turns at w, or circles there.
WideTurns turns_from(const Space& s, const Constants& c, const Wide& w) {
  const WidePolynomial p = radial_polynomial(s, c);
  const Wide inside = w * (1 + kRootBeside), outside = w * (1 - kRootBeside);
  if (value(p, inside) > 0) return turns_between(s, c, w, next_root(p, inside, true));
  if (value(p, outside) > 0) return turns_between(s, c, next_root(p, outside, false), w);
  return turns_between(s, c, w, w);
}

// ---- the circles that bound what falls into a hole ----

Constants circle_constants(const Space& s, const Wide& w) {
  const Wide below = 1 + w * (2 * s.q2 * w - 3), f = s.f(w);
  return {(f * f - below) / below, (1 - s.q2 * w) / (w * below)};
}

Wide light_circle(const Space& s) { return 2 / (3 + sqrt(Wide(9 - 8 * s.q2))); }
Wide last_stable(const Space& s) { return roots_of({1, -6, 9 * s.q2, -4 * s.q2 * s.q2}).front(); }

// Returns w of the unstable circle of that energy.
Wide barrier(const Space& s, const Wide& excess) {
  const auto beyond = [&](const Wide& w) {
    return s.f(w) * s.f(w) - (1 + excess) * (1 + w * (2 * s.q2 * w - 3));
  };
  return wide_zero(beyond, last_stable(s), light_circle(s));
}

// Returns w of the unstable circle whose constants let an orbit turn at far(w), too.
template <class Far>
Wide separatrix(const Space& s, const Far& far) {
  // P/(x - w)^2 is n + m x - a x^2.
  const auto at_far = [&](const Wide& w) -> Wide {
    const Constants c = circle_constants(s, w);
    const Wide a = s.q2 * c.l2, x = far(w);
    return c.excess / (w * w) + x * (2 * (c.l2 - a * w) - a * x);
  };
  return wide_zero(at_far, last_stable(s), barrier(s, 0));
}

double capture_momentum(const Space& s, const Wide& excess) {
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
void require_scattering(const Space& s, double excess, double l, bool comes_back) {
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
void require_turn(const Space& s, double r, double excess) {
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

Constants turning_at(const Space& s, const Wide& w, const Wide& excess) {
  return {excess, ((1 + excess) / s.f(w) - 1) / (w * w)};
}

// Returns the least semilatus rectum of that eccentricity.
Wide least_rectum(const Space& s, const Wide& e) {
  return (1 + e) / separatrix(s, [&](const Wide& w) { return Wide(w * (1 - e) / (1 + e)); });
}

// Returns the orbit between two turning points, which are in their order.
WideTurns turns_of_ends(const Space& s, const Wide& w1, const Wide& w2) {
  if (w1 == w2) return turns_between(s, circle_constants(s, w1), w1, w1);
  const Wide f1 = s.f(w1), f2 = s.f(w2), l2 = (f1 - f2) / (f2 * w2 * w2 - f1 * w1 * w1);
  const Constants c{f1 * l2 * w1 * w1 + (f1 - 1), l2};
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
  const Space s(hole);
  require_turn(s, r, excess_energy);
  const Wide w = 1 / Wide(r);
  const Constants c = turning_at(s, w, excess_energy);
  const WidePolynomial p = radial_polynomial(s, c);
  const Wide outside = w * (1 - kRootBeside);
  if (!(c.l2 >= 0 && value(p, outside) > 0 && next_root(p, outside, false) <= 0))
    throw std::domain_error("periastron is where nothing turns that comes from infinity so, got " +
                            short_number(r));
  return ChargedOrbit(turns_between(s, c, next_root(p, outside, false), w).turns);
}

ChargedOrbit ChargedOrbit::scattered(const ChargedHole& hole, double excess_energy, double l) {
  const Space s(hole);
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
  const Space s(hole);
  const Wide more = 1 + Wide(excess),
             l2 = circle_constants(s, barrier(s, excess_energy)).l2 * more * more;
  return ChargedOrbit(turns_about(s, {excess_energy, l2}, 0).turns);
}

ChargedOrbit ChargedOrbit::by_speed_excess(const ChargedHole& hole, double r, double excess) {
  require_hole(hole);
  const Space s(hole);
  require_above("periastron", "units of M", r, hole.light_circle(), "no orbit turns there");
  require_below("periastron", "units of M", r, static_cast<double>(1 / barrier(s, 0)),
                "from there on any speed is enough");
  require_excess(excess, "of the speed over its bound, in parts",
                 "the orbit would never leave its periastron");
  const Wide w = 1 / Wide(r), least = circle_constants(s, w).excess, more = 1 + Wide(excess);
  const Wide v2 = least / (1 + least) * more * more;
  require_below("v_inf", "fraction of c", static_cast<double>(sqrt(v2)), 1,
                "nothing outruns light");
  const Constants c = turning_at(s, w, v2 / (1 - v2));
  const Wide outside = w * (1 - kRootBeside);
  return ChargedOrbit(
      turns_between(s, c, next_root(radial_polynomial(s, c), outside, false), w).turns);
}

// ---- bound ----

ChargedOrbit ChargedOrbit::between(const ChargedHole& hole, double periastron, double apoastron) {
  const Space s(hole);
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
  const Space s(hole);
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
  const Space s(hole);
  const Wide p = least_rectum(s, e) + excess;
  return ChargedOrbit(turns_of_ends(s, (1 - Wide(e)) / p, (1 + Wide(e)) / p).turns);
}

// ---- falls and throws ----

ChargedOrbit ChargedOrbit::from_rest(const ChargedHole& hole, double r, double l) {
  require_above("rest_r", "units of M", r, hole.horizon(),
                hole.is_naked() ? "it is a radius" : "nothing rests at or inside the horizon");
  require_momentum(l);
  const Space s(hole);
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
  const Space s(hole);
  require_above("from_r", "units of M", r, 0, "it is a radius");
  require_scattering(s, excess_energy, l, false);
  const Constants c{excess_energy, Wide(l) * l};
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
  const Space s(hole);
  const Wide w = 1 / Wide(r), f = s.f(w), u2 = Wide(radial) * radial, l = Wide(r) * tangential;
  const Constants c{f * (u2 + Wide(tangential) * tangential) + (f - 1), l * l};
  const WideTurns t = radial == 0 ? turns_from(s, c, w) : turns_about(s, c, w);
  return counted_from(t.turns, t.above(w), t.below(w), radial > 0 ? Leg::kOutward : Leg::kInward);
}

ChargedOrbit ChargedOrbit::thrown_from_tetrad(const ChargedHole& hole, double r, double radial,
                                              double tangential) {
  require_above("r", "units of M", r, 0, "it is a radius");
  const Space s(hole);
  const Wide w = 1 / Wide(r), f = s.f(w), l = Wide(r) * tangential;
  const Wide gamma = sqrt(Wide(1 + Wide(radial) * radial + Wide(tangential) * tangential));
  const Wide energy = (1 + f) / 2 * gamma - (1 - f) / 2 * radial,
             rate = (1 + f) / 2 * radial - (1 - f) / 2 * gamma;
  if (abs(energy) < kNoEnergy * gamma)
    throw std::domain_error(
        "speed leads through the crossing of the inner horizons, where no tetrad is regular; "
        "change it a little");
  const Constants c{energy * energy - 1, l * l};
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
  const Space s(hole);
  const Wide wc = 1 / Wide(circle), w = wc + over;
  Constants c = circle_constants(s, wc);
  c.excess += more;
  const WideTurns t = turns_about(s, c, w);
  return counted_from(t.turns, t.above(w), t.below(w), Leg::kInward);
}

}  // namespace domefall
