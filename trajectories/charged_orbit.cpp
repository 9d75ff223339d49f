#include "trajectories/charged_orbit.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "trajectories/flight_table.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/short_number.h"
#include "trajectories/square.h"

namespace domefall {
namespace {

using Polynomial = std::vector<long double>;  // coefficients of rising powers

constexpr double kOutermost = 1e10;  // M

long double value(const Polynomial& p, long double x) {
  long double sum = 0;
  for (std::size_t k = p.size(); k > 0; --k) sum = sum * x + p[k - 1];
  return sum;
}

// Returns the real roots in their order.  Between two roots of its derivative a polynomial has one
// root at most.  Double roots may be missed.
std::vector<long double> roots_of(Polynomial p) {
  while (p.size() > 1 && p.back() == 0) p.pop_back();
  if (p.size() < 2) return {};
  Polynomial slope;
  for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(p[k] * static_cast<long double>(k));
  long double largest = 0;
  for (const long double c : p) largest = std::max(largest, std::abs(c / p.back()));
  std::vector<long double> ends = roots_of(slope), roots;
  ends.insert(ends.begin(), -1 - largest);
  ends.push_back(1 + largest);
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const long double low = value(p, ends[k - 1]), high = value(p, ends[k]);
    if (high == 0) roots.push_back(ends[k]);
    if (!(low < 0 && high > 0) && !(low > 0 && high < 0)) continue;
    std::uintmax_t steps = 300;
    const auto found = boost::math::tools::toms748_solve(
        [&p](long double x) { return value(p, x); }, ends[k - 1], ends[k], low, high,
        boost::math::tools::eps_tolerance<long double>(63), steps);
    roots.push_back((found.first + found.second) / 2);
  }
  return roots;
}

Polynomial radial_polynomial(const ChargedHole& hole, long double excess_energy, long double l) {
  const long double q2 = hole.charge_long() * hole.charge_long(), l2 = l * l;
  return {excess_energy, 2, -(q2 + l2), 2 * l2, -q2 * l2};
}

// Returns p/(w - root), whose remainder is left out.
Polynomial divided(const Polynomial& p, long double root) {
  Polynomial quotient(p.size() - 1);
  long double sum = 0;
  for (std::size_t k = p.size() - 1; k > 0; --k) quotient[k - 1] = sum = p[k] + root * sum;
  return quotient;
}

// Returns the root next to w, above it or below.
long double next_root(const Polynomial& p, long double w, bool above) {
  const std::vector<long double> roots = roots_of(p);
  const auto after = std::upper_bound(roots.begin(), roots.end(), w);
  if (above ? after == roots.end() : after == roots.begin())
    throw std::domain_error("r is where such an orbit cannot turn");
  return above ? *after : *(after - 1);
}

void require_momentum(double l) {
  require_at_least("angular_momentum", "units of M", l, 0, "the sense of an orbit is its heading");
}

}  // namespace

struct ChargedOrbit::Tables {
  ChargedHole hole;
  double energy, l;
  double near, far;   // the turning radii; far is infinite for what is not bound
  double w1;          // 1/far, or the negative root
  double a, b, c;     // Q = a w^2 + b w + c = P/((w - w1)(w2 - w))
  double span;        // of s, from the periastron to the far end of the table
  double star_near;   // r* at the periastron
  FlightTable times;  // from there, of u where r grows

  Tables(const ChargedHole& of, double excess_energy, double momentum, double periastron,
         double root);

  bool is_bound() const { return w1 > 0; }
  bool passes() const { return near < hole.inner_horizon(); }
  double period() const { return 2 * times.whole().tau; }

  struct Place {
    double r, radial, rate;  // dr/dtau >= 0, dtau/ds
  };
  Place place(double s) const {
    const double sine = is_bound() ? std::sin(s / 2) : std::sinh(s);
    const double r = near * (1 + (is_bound() ? (far / near - 1) : 1) * square(sine));
    const double w = 1 / r, q = (a * w + b) * w + c;
    if (is_bound()) {
      const double root = std::sqrt(q / (near * far));
      return {r, (far - near) * std::sin(s) / 2 * root / r, r / root};
    }
    const double root = std::sqrt((w - w1) * q);
    return {r, sine * root / std::sqrt(r), 2 * r * std::sqrt(near) / root};
  }
  double parameter(double r) const {
    const double above = std::max(0.0, r - near);
    if (!is_bound()) return std::asinh(std::sqrt(above / near));
    return 2 * std::atan2(std::sqrt(above), std::sqrt(std::max(0.0, far - r)));
  }
  FlightTable::Times rates(double q) const {
    const Place p = place(q * span);
    const double rate = p.rate * span, turn = l / p.r;
    return {rate, rate * (1 + square(turn)) / (energy + p.radial), rate * turn / p.r};
  }
};

ChargedOrbit::Tables::Tables(const ChargedHole& of, double excess_energy, double momentum,
                             double periastron, double root)
    : hole(of),
      energy(std::sqrt(1 + excess_energy)),
      l(momentum),
      near(periastron),
      far(root > 0 ? 1 / root : kInfinity),
      w1(root),
      a(square(of.charge * momentum)),
      b(a * (root + 1 / periastron) - 2 * square(momentum)),
      c(square(of.charge) + square(momentum) + b * (root + 1 / periastron) - a * root / periastron),
      span(parameter(std::min(far, std::max(kOutermost, 2 * near)))),
      star_near(of.tortoise(periastron)),
      times([this](double q) { return rates(q); }) {}

ChargedOrbit ChargedOrbit::with_roots(const ChargedHole& hole, double excess_energy, double l,
                                      double periastron, double w1) {
  return ChargedOrbit(std::make_shared<const Tables>(hole, excess_energy, l, periastron, w1));
}

ChargedOrbit ChargedOrbit::through(const ChargedHole& hole, double r, double excess_energy,
                                   double l) {
  require_momentum(l);
  const Polynomial p = radial_polynomial(hole, excess_energy, l);
  if (value(p, 1 / static_cast<long double>(r)) < 0)
    throw std::domain_error("r must be where such an orbit can be, got " + short_number(r));
  const long double w = 1 / static_cast<long double>(r);
  return with_roots(hole, excess_energy, l, static_cast<double>(1 / next_root(p, w, true)),
                    static_cast<double>(next_root(p, w, false)));
}

ChargedOrbit ChargedOrbit::from_rest(const ChargedHole& hole, double r, double l) {
  require_above("rest_r", "units of M", r, hole.horizon(),
                "nothing rests at or inside the horizon");
  require_momentum(l);
  const long double w = 1 / static_cast<long double>(r), q = hole.charge_long();
  const long double fall = w * (q * q * w - 2), excess = fall + l * l * w * w * (1 + fall);
  const Polynomial rest = divided(radial_polynomial(hole, excess, l), w);
  // Where the other factor is negative, r is the periastron.
  if (value(rest, w) < 0)
    return with_roots(hole, static_cast<double>(excess), l, r,
                      static_cast<double>(next_root(rest, w, false)));
  return with_roots(hole, static_cast<double>(excess), l,
                    static_cast<double>(1 / next_root(rest, w, true)), static_cast<double>(w));
}

ChargedOrbit ChargedOrbit::by_periastron(const ChargedHole& hole, double r, double excess_energy) {
  require_above("periastron", "units of M", r, hole.horizon(),
                "inside the horizon none is given by its periastron");
  const long double w = 1 / static_cast<long double>(r), q = hole.charge_long();
  const long double f = 1 + w * (q * q * w - 2);
  const auto l = static_cast<double>(std::sqrt((excess_energy + 1 - f) / f) / w);
  const Polynomial rest = divided(radial_polynomial(hole, excess_energy, l), w);
  if (!(value(rest, w) < 0))
    throw std::domain_error("periastron must be larger, got " + short_number(r) +
                            ": from there such an orbit falls into the hole");
  return with_roots(hole, excess_energy, l, r, static_cast<double>(next_root(rest, w, false)));
}

ChargedOrbit ChargedOrbit::between(const ChargedHole& hole, double periastron, double apoastron) {
  require_above("periastron", "units of M", periastron, hole.horizon(),
                "one inside the horizon follows from rest_r of an infall");
  require_above("apoastron", "units of M", apoastron, periastron,
                "it is the farthest point of the orbit");
  const long double w1 = 1 / static_cast<long double>(apoastron), q = hole.charge_long(),
                    w2 = 1 / static_cast<long double>(periastron);
  const long double f1 = 1 + w1 * (q * q * w1 - 2), f2 = 1 + w2 * (q * q * w2 - 2);
  // E^2 = f (1 + L^2 w^2) at both ends.
  const long double l2 = (f1 - f2) / (f2 * w2 * w2 - f1 * w1 * w1);
  const long double excess = f1 * l2 * w1 * w1 + (f1 - 1);
  if (!(l2 > 0)) throw std::domain_error("periastron is too near for an orbit that rises so far");
  const Polynomial rest = divided(divided(radial_polynomial(hole, excess, std::sqrt(l2)), w1), w2);
  if (!(value(rest, w2) < 0 && value(rest, w1) < 0))
    throw std::domain_error("periastron must be larger, got " + short_number(periastron) +
                            ": an orbit that rises so far falls into the hole");
  return with_roots(hole, static_cast<double>(excess), static_cast<double>(std::sqrt(l2)),
                    periastron, static_cast<double>(w1));
}

double ChargedOrbit::energy() const { return tables_->energy; }
double ChargedOrbit::angular_momentum() const { return tables_->l; }
double ChargedOrbit::innermost() const { return tables_->near; }
double ChargedOrbit::outermost() const { return tables_->far; }
bool ChargedOrbit::passes() const { return tables_->passes(); }
double ChargedOrbit::radial_period() const {
  return tables_->is_bound() ? tables_->period() : kInfinity;
}
double ChargedOrbit::birth() const {
  return tables_->is_bound() ? -kInfinity : -tables_->times.whole().tau;
}

OrbitPoint ChargedOrbit::at(const ProperTime& tau) const {
  const Tables& t = *tables_;
  ProperTime own = tau;
  double turns = 0;
  if (t.is_bound()) {
    turns = std::floor(double(tau) / t.period() + 0.5);
    own = tau - exact_product(turns, t.period());
  } else if (!(std::abs(double(tau)) <= t.times.whole().tau)) {
    throw std::domain_error("proper time " + short_number(double(tau)) +
                            " (units of M) is beyond the orbit's ends");
  }
  const double side = double(own) < 0 ? -1 : 1;
  const double s = t.times.parameter(std::abs(double(own)));
  const Tables::Place p = t.place(s * t.span);
  const FlightTable::Times sums = t.times.to_go(s), whole = t.times.whole();
  const bool passed = t.passes() && side > 0;
  const double star = t.passes() ? 0 : t.hole.tortoise(p.r);
  // These count from the periastron, and t is 0 there.
  const double time = side < 0 ? t.star_near - sums.null_time
                      : passed ? sums.null_time - t.star_near
                               : sums.null_time - t.star_near + 2 * star;
  OrbitPoint point;
  point.r = p.r;
  point.tetrad = passed ? Tetrad::kOutgoing : Tetrad::kRain;
  point.region = p.r > t.hole.horizon()         ? Region::kI
                 : p.r < t.hole.inner_horizon() ? Region::kV
                 : passed                       ? Region::kIV
                                                : Region::kII;
  point.universe =
      t.passes() ? static_cast<int>(turns) + (passed && point.region != Region::kV) : 0;
  point.azimuth = side * sums.azimuth + 2 * turns * whole.azimuth;
  const double turn = t.l / p.r;
  point.celerity = {
      t.hole.radial_celerity(t.hole.at(p.r), side * p.radial, t.energy, square(turn), passed), 0,
      turn};
  point.null_time = time;
  if (turns != 0)
    point.null_time =
        point.null_time +
        exact_product(2 * turns, whole.null_time + t.hole.tortoise(t.far) - t.star_near);
  return point;
}

std::optional<ProperTime> ChargedOrbit::time_at(double r, Leg leg, const ProperTime& after) const {
  const Tables& t = *tables_;
  if (!(r >= t.near && r <= t.far && r <= kOutermost)) return std::nullopt;
  const double side = leg == Leg::kOutward ? 1 : -1;
  ProperTime tau = side * t.times.to_go(std::min(1.0, t.parameter(r) / t.span)).tau;
  if (!t.is_bound()) return tau < after ? std::nullopt : std::optional(tau);
  const ProperTime start = after == -kInfinity ? -t.period() / 2 : after;
  tau = tau + exact_product(std::ceil(double(start - tau) / t.period()), t.period());
  if (tau < start) tau = tau + t.period();
  return tau;
}

std::optional<ProperTime> ChargedOrbit::next_periastron(const ProperTime& after) const {
  return time_at(innermost(), Leg::kOutward, after);
}

namespace {

double circle_root(const ChargedCircle& orbit) {
  return std::sqrt(orbit.r * (orbit.r - 3) + 2 * square(orbit.hole.charge));
}
// Returns L/r.
double circle_turning(const ChargedCircle& orbit) {
  return std::sqrt(orbit.r - square(orbit.hole.charge)) / circle_root(orbit);
}

}  // namespace

double period(const ChargedCircle& orbit) {
  return 2 * std::numbers::pi * orbit.r / circle_turning(orbit);
}

OrbitPoint ChargedCircle::at(const ProperTime& tau) const {
  const double turning = circle_turning(*this), root = circle_root(*this);
  const ChargedRadius place = hole.at(r);
  const double energy = r * hole.lapse_squared(place) / root;
  return {Region::kI,
          Tetrad::kRain,
          r,
          double(tau) * turning / r,
          {hole.radial_celerity(place, 0, energy, square(turning), false), 0, turning},
          double(tau) * (r / root)};
}

}  // namespace domefall
