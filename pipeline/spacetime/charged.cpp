#include "pipeline/spacetime/charged.h"

#include <boost/math/special_functions/log1p.hpp>
#include <limits>

namespace domefall {
namespace {

using Long = long double;

// Returns the integral of r^2/Delta from 0 by its series, for r well below the first horizon.  With
// z = r/q the integrand is z^2/(1 - (2/q) z + z^2).
Long tortoise_series(Long r, Long q) {
  const Long z = r / q;
  Long before = 0, c = 1, power = r * z * z, sum = 0;
  for (int n = 3; n < 200; ++n) {
    sum += c * power / n;
    if ((std::abs(c) + std::abs(before)) * power < 1e-20L * std::abs(sum)) break;
    const Long next = 2 * c / q - before;
    before = c;
    c = next;
    power *= z;
  }
  return sum;
}

// Returns ln|1 + x| - x.
Long log_less_linear(Long x) {
  return std::abs(x) < 0.5L ? boost::math::log1pmx(x) : std::log(std::abs(1 + x)) - x;
}

}  // namespace

Long ChargedHole::charge_long() const {
  return std::abs(below_extremal) < 0.5 ? 1 - Long{below_extremal} : Long{charge};
}

Long ChargedHole::horizon_distance_squared() const {
  const Long q = charge_long();
  return (1 - q) * (1 + q);
}

Long ChargedHole::outer_horizon() const { return 1 + std::sqrt(horizon_distance_squared()); }

Long ChargedHole::inner_radius() const {
  const Long q = charge_long();
  return q * q / outer_horizon();
}

Long ChargedHole::nine_less_eight_squares() const {
  const Long q = charge_long();
  return 9 - 8 * q * q;
}

Long ChargedHole::circle() const { return (3 + std::sqrt(nine_less_eight_squares())) / 2; }

Long ChargedHole::kappa() const {
  const Long q = charge_long(), c = circle();
  return c * c / std::sqrt(c - q * q);
}

// This is kappa/sqrt(r_c) - r_c, which cancels for small charges.
Long ChargedHole::edges_radius() const {
  const Long q2 = charge_long() * charge_long(), c = circle(), rest = c - q2;
  return c * (q2 / rest) / (std::sqrt(c / rest) + 1);
}

double ChargedHole::last_stable_orbit() const {
  // With r = 2 + s the cubic is s^3 - 3 m^2 s - 2 n = 0.
  const double q2 = charge * charge;
  if (q2 > 1.25) return q2;
  const double m = std::sqrt(4 - 3 * q2), n = 2 * q2 * q2 - 9 * q2 + 8;
  const double c = n / (m * m * m);
  return 2 + 2 * m * (c > 1 ? std::cosh(std::acosh(c) / 3) : std::cos(std::acos(c) / 3));
}

double ChargedHole::circling_time(double r) const {
  const Long q2 = charge_long() * charge_long();
  const Long below =
      has_light_circle() ? (r - circle()) * (r - 3 + circle()) : Long{r} * (r - 3) + 2 * q2;
  return static_cast<double>(std::sqrt(below / (r - q2)));
}

// Of r_- - r_x it is known that (r_- - r_c)^2 (r_- - r_x) (r_- + r_c + kappa/sqrt(r_c)) = r_-^4.
Long ChargedHole::edges_below_inner() const {
  const Long c = circle(), r = inner_radius(), square = r * r / (c - r);
  return square * square / (r + c + kappa() / std::sqrt(c));
}

ChargedRadius ChargedHole::at(Long r) const {
  const bool circles = has_light_circle();
  const auto radius = static_cast<double>(r);
  const auto above_circle = static_cast<double>(circles ? r - circle() : r);
  if (is_naked()) {
    const auto middle = static_cast<double>(r - 1);
    return {radius, middle, middle, above_circle,
            static_cast<double>(circles ? r - edges_radius() : r)};
  }
  // (r - 1) -+ d is exact beside both horizons, also where they are close to each other.
  const Long d = std::sqrt(horizon_distance_squared());
  const Long inner = r > 0.5L ? (r - 1) + d : r - inner_radius();
  return {radius, static_cast<double>((r - 1) - d), static_cast<double>(inner), above_circle,
          static_cast<double>(inner + edges_below_inner())};
}

ChargedRadius ChargedHole::at(ChargedMark mark, double distance) const {
  const auto place = [&] {
    if (mark == ChargedMark::kLightCircle) return circle();
    if (is_naked()) return Long{1};
    return mark == ChargedMark::kOuterHorizon ? outer_horizon() : inner_radius();
  };
  ChargedRadius out = at(place() + distance);
  if (mark == ChargedMark::kLightCircle) {
    out.above_light_circle = distance;
    return out;
  }
  // The horizons are 2d apart, which may be little.
  const Long gap = is_naked() ? 0 : 2 * std::sqrt(horizon_distance_squared());
  const bool outer = mark == ChargedMark::kOuterHorizon;
  out.above_outer = static_cast<double>(outer ? Long{distance} : distance - gap);
  out.above_inner = static_cast<double>(outer ? distance + gap : Long{distance});
  if (!is_naked()) out.above_edges = static_cast<double>(out.above_inner + edges_below_inner());
  return out;
}

Long ChargedHole::delta(const ChargedRadius& at) const {
  const Long product = Long{at.above_outer} * at.above_inner;
  return is_naked() ? product - horizon_distance_squared() : product;
}

double ChargedHole::lapse_squared(const ChargedRadius& at) const {
  return std::isinf(at.r) ? 1 : static_cast<double>(delta(at) / at.r / at.r);
}

double ChargedHole::resting_celerity(const ChargedRadius& at) const {
  const double f = std::abs(lapse_squared(at)), root = std::sqrt(f);
  return (1 - f) / (2 * root);
}

double ChargedHole::fall_celerity(double r) const {
  const double s = free_fall_speed(r);
  return -s * (2 + s) / (2 * (1 + s));
}

double ChargedHole::radial_celerity(const ChargedRadius& at, double radial, double energy,
                                    double l2, bool outgoing) const {
  // The components along n and l are (1 + l^2)/(E - u^r) and (E - u^r)/2, whose product is fixed.
  const double u = outgoing ? -radial : radial;
  const bool direct = u <= 0 || energy <= 0;
  const double falling = direct ? energy - u : lapse_squared(at) * (1 + l2) / (energy + u);
  const double w = ((1 + l2) / falling - falling) / 2;
  return outgoing ? -w : w;
}

double ChargedHole::tortoise(const ChargedRadius& at) const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Long r = at.r, q = charge_long(), q2 = q * q, d2 = horizon_distance_squared();
  if (is_naked()) {
    if (r < q / 4) return static_cast<double>(tortoise_series(r, q));
    const Long root = std::sqrt(-d2);
    return static_cast<double>(r + std::log(delta(at) / q2) +
                               (2 - q2) / root * std::atan2(r * root, q2 - r));
  }
  if (at.above_outer == 0) return -kInfinite;
  if (at.above_inner == 0) return kInfinite;
  const Long d = std::sqrt(d2), outer = outer_horizon(), inner = inner_radius();
  if (r < inner / 4) return static_cast<double>(tortoise_series(r, q));
  if (d > 0.5L) {
    // r_+^2/(2d) ln|1 - r/r_+| - r_-^2/(2d) ln|1 - r/r_-|, whose linear parts make r vanish.
    const Long far = outer * outer *
                     (r < outer / 2 ? log_less_linear(-r / outer)
                                    : std::log(std::abs(Long{at.above_outer}) / outer) + r / outer);
    const Long near =
        inner > 0 ? inner * inner * (std::log(std::abs(Long{at.above_inner}) / inner) + r / inner)
                  : 0;
    return static_cast<double>((far - near) / (2 * d));
  }
  // ln|1 - x|/x tends to -1 as the horizons become one.
  const Long scale = r / (at.above_inner * outer), x = 2 * d * scale;
  const Long log = std::abs(x) < 0.5L ? std::log1p(-x)
                                      : std::log(std::abs(Long{at.above_outer} * inner) /
                                                 std::abs(Long{at.above_inner} * outer));
  const Long ratio = x == 0 ? -1 : log / x;
  return static_cast<double>(r + std::log(std::abs(delta(at)) / q2) + (2 - q2) * scale * ratio);
}

ChargedHole::CriticalTangents ChargedHole::critical_tangents(const ChargedRadius& at) const {
  const Long r = at.r, c = circle(), k = kappa(), f = delta(at) / r / r;
  // X/(kappa r), from X^2 = (r - r_c)^2 (r - r_x) (r + r_c + kappa/sqrt(r_c)).
  const Long square = (Long{at.above_edges} / r) * ((r + c + k / std::sqrt(c)) / r);
  const Long x = at.above_light_circle / k * std::sqrt(std::abs(square)), middle = r / k;
  if (square < 0) return {false, middle, middle, 2 * std::abs(x)};
  if (x >= 0) return {true, f / (middle + x), middle + x, 2 * x};
  return {true, middle - x, f / (middle - x), 2 * x};
}

// r* = r + (1 + k) ln(r - r_+) + (1 - k) ln(r - r_-) with k = (2 - q^2)/(2 d).  Where the horizons
// are one, the terms with k are -(2 - q^2)/(r - 1) together.
PixelTortoise::PixelTortoise(const ChargedHole& hole)
    : outer_(hole.horizon()), inner_(hole.inner_horizon()) {
  const Long q = hole.charge_long(), d = std::sqrt(hole.horizon_distance_squared());
  const Long k = d > 0 ? (2 - q * q) / (2 * d) : 0;
  by_outer_ = static_cast<double>(1 + k);
  by_inner_ = static_cast<double>(1 - k);
  pole_ = d > 0 ? 0 : 1;
  constexpr double kSomewhere = 10;
  shift_ = hole.tortoise(kSomewhere) - at(kSomewhere, [](double x) { return std::log(x); });
}

}  // namespace domefall
