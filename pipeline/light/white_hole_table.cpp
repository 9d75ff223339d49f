#include "pipeline/light/white_hole_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// The laws take over here, in units of the smallest scale on their side.  The first is never below
// the second, which matters only where the light circle is nearer to the observer than 1e-9.
constexpr double kEdgeInnermost = 1e-6, kLeastApart = 1e-15, kAxisInnermost = 1.0 / 1024;
// At r = 2 itself T_0 and the edge of region III are points.  A depth whose square root is below
// 1e-15 stands for none.
constexpr double kHorizonDepth = -1e-30;

// 1,024 nodes hold this at 16 intervals to the octave.
constexpr double kFineOctaves = 62;

Radius off_the_horizon(Radius at) {
  if (at.above_horizon == 0) at.above_horizon = kHorizonDepth;
  return at;
}

}  // namespace

// ---- the law next to the axis ----

double AxisLaw::azimuth(double y) const {
  const double t = std::cbrt(y / y_min), u = t * t;
  return t * (c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4]))));
}

double AxisLaw::slope(double y) const {
  const double t = std::cbrt(y / y_min), u = t * t;
  const double by_t = c[0] + u * (3 * c[1] + u * (5 * c[2] + u * (7 * c[3] + u * 9 * c[4])));
  return by_t / (3 * u * y_min);
}

double AxisLaw::distance(double phi) const {
  if (phi == 0) return 0;
  double t = phi / c[0];
  for (int k = 0; k < 20; ++k) {
    const double y = y_min * t * t * t;
    const double step = (phi - azimuth(y)) / (slope(y) * 3 * y_min * t * t);
    t += step;
    if (!(std::abs(step) > 1e-16 * t)) break;
  }
  return y_min * t * t * t;
}

namespace {

// phi/t is a polynomial of degree 4 in u = t^2, found by Newton's divided differences at u = 4^-k.
AxisLaw fit_axis_law(double y_min, const std::function<double(double)>& phi) {
  constexpr int kTerms = 5;
  std::array<double, kTerms> u{}, d{};
  for (int k = 0; k < kTerms; ++k) {
    u[k] = std::ldexp(1.0, -2 * k);
    d[k] = phi(std::ldexp(y_min, -3 * k)) * std::ldexp(1.0, k);
  }
  for (int j = 1; j < kTerms; ++j)
    for (int k = kTerms - 1; k >= j; --k) d[k] = (d[k] - d[k - 1]) / (u[k] - u[k - j]);
  AxisLaw law{y_min, {}};
  for (int j = kTerms - 1; j >= 0; --j) {  // c <- c (u - u_j) + d_j
    for (int k = kTerms - 1; k > 0; --k) law.c[k] = law.c[k - 1] - u[j] * law.c[k];
    law.c[0] = d[j] - u[j] * law.c[0];
  }
  return law;
}

}  // namespace

// ---- making the table ----

WhiteHoleTable::WhiteHoleTable(const Radius& at, bool outgoing, int bits)
    : WhiteHoleTable(off_the_horizon(at),
                     at.above_horizon > 0 ? (outgoing ? Kind::kOutsideOutgoing : Kind::kOutside)
                                          : (outgoing ? Kind::kWhiteHole : Kind::kInside),
                     bits) {}

WhiteHoleTable::WhiteHoleTable(const Radius& at, Kind kind, int bits)
    : at_(at),
      kind_(kind),
      first_(tan_half_critical(at_, Critical::kFirst)),
      second_(tan_half_critical(at_, Critical::kSecond)),
      zero_(kappa(at_, {kind == Kind::kWhiteHole, true})),
      place_(ratios()),
      range_(range()),
      curve_(
          range_.low, range_.high, [this](double s) { return exact_azimuth(ray_at_place(s)); },
          // Next to E = 0 phi hardly changes with the angle, so its error is more of one on the
          // sky.
          (kind == Kind::kInside || kind == Kind::kWhiteHole) &&
                  std::log2(range_.high / range_.low) < kFineOctaves
              ? bits + 1
              : bits) {
  const auto phi = [this](double s) { return exact_azimuth(ray_at_place(s)); };
  if (has_edge()) edge_law_ = fit_edge_law(curve_.x_min(), 1, phi);
  if (is_outside())
    axis_law_ = fit_axis_law(1 / (1 + range_.high), [&](double y) { return phi((1 - y) / y); });
  if (kind_ == Kind::kWhiteHole) axis_law_ = fit_axis_law(curve_.x_min(), phi);
  if (is_outside()) return;
  const OctaveCurve::Jet jet = curve_.at(range_.high);
  // This is d s/d alpha at T_0, where d phi/d s = 0.
  const double rate = (1 + zero_ * zero_) / 2 / (has_edge() ? second_ : zero_);
  turn_ = Turn{2 * std::atan(zero_), jet.value, jet.second * rate * rate};
}

WhiteHoleTable::Range WhiteHoleTable::range() const {
  if (kind_ == Kind::kWhiteHole) return {kAxisInnermost * axis_scale(), 1};
  if (kind_ == Kind::kInside) {
    const double end = zero_ / second_ - 1;
    return {kEdgeInnermost * std::min(1.0, end), end};
  }
  const double apart = std::abs(first_ - second_) / (kind_ == Kind::kOutside ? first_ : second_);
  const double scale = apart > 0 ? std::clamp(apart, kLeastApart / kEdgeInnermost, 1.0) : 1;
  return {kEdgeInnermost * scale, 1 / (kAxisInnermost * axis_scale())};
}

// Returns the y at which b = |L/E| is 1 (r^(3/2) where that is less).  There the branch point of
// b^(1/3) gives way to other laws.
double WhiteHoleTable::axis_scale() const {
  const double r = at_.r, s = Schwarzschild::free_fall_speed(r);
  const double inner = std::abs(Schwarzschild::below_light_speed(at_));
  if (kind_ == Kind::kOutside) return std::min(1.0, inner / (2 * r * first_));
  if (kind_ == Kind::kOutsideOutgoing) return std::min(1.0, second_ * (1 + s) / (2 * r));
  const double at_rest = std::sqrt(inner * (1 + s));  // |E| of a radial ray
  return std::min(1.0, at_rest / (2 * r) * std::min(1.0, r * std::sqrt(r)));
}

NullRay WhiteHoleTable::ray_at_place(double s) const {
  switch (kind_) {
    case Kind::kOutside:
      return s < 1 ? ray_of_ratio(at_, Critical::kFirst, -s / (1 + s), false)
                   : ray_of_tangent(at_, first_ / (1 + s), false);
    case Kind::kOutsideOutgoing:
      return s < 1 ? ray_of_ratio(at_, Critical::kSecond, s, true)
                   : ray_of_tangent(at_, second_ * (1 + s), true);
    case Kind::kInside:
      return ray_of_ratio(at_, Critical::kSecond, s, false);
    case Kind::kWhiteHole:
      break;
  }
  return ray_of_tangent(at_, zero_ * s, true);
}

NullRay WhiteHoleTable::other_half(double s) const {
  if (kind_ == Kind::kInside) return ray_of_ratio(at_, Critical::kFirst, -s / (1 + s), false);
  return ray_of_tangent(at_, zero_ / s, true);
}

// ---- using it ----

WhiteHolePlace WhiteHoleTable::ratios() const {
  using Ratio = WhiteHolePlace::Ratio;
  const Ratio above_second{1, -second_, 0, second_}, below_first{-1, first_, 1, 0};
  switch (kind_) {
    case Kind::kOutside:
      return {zero_, below_first, below_first};
    case Kind::kOutsideOutgoing:
      return {zero_, above_second, above_second};
    case Kind::kInside:
      return {zero_, above_second, below_first};
    case Kind::kWhiteHole:
      break;
  }
  return {zero_, Ratio{1, 0, 0, zero_}, Ratio{0, zero_, 1, 0}};
}

WhiteHoleTable::Place WhiteHoleTable::place_of(double sin_half, double cos_half) const {
  Place p{};
  p.s = place_(sin_half, cos_half, p.rate);
  return p;
}

// The numerators are found by way of the ray's exact gaps.
WhiteHoleTable::Place WhiteHoleTable::place_of(const NullRay& ray) const {
  Place p = place_of(ray.sin_half, ray.cos_half);
  const bool beyond = ray.sin_half > zero_ * ray.cos_half;
  if (kind_ == Kind::kOutside || (kind_ == Kind::kInside && beyond))
    p.s = -ray.gap_first / ray.sin_half;
  else if (has_edge())
    p.s = ray.gap_second / (second_ * ray.cos_half);
  return p;
}

WhiteHoleTable::Lookup WhiteHoleTable::lookup() const {
  return {place_, curve_.lookup(), curve_.x_min(), is_outside() ? range_.high : HUGE_VAL};
}

// On an edge itself phi is infinite, and the nearest place to it that a number can hold stands for
// it.
WhiteHoleTable::Place WhiteHoleTable::off_edge(const Place& p) const {
  return {has_edge() ? std::max(p.s, std::numeric_limits<double>::min()) : p.s, p.rate};
}

double WhiteHoleTable::azimuth(const Place& place) const {
  const Place p = off_edge(place);
  if (p.s < curve_.x_min()) return has_edge() ? edge_law_.azimuth(p.s) : axis_law_.azimuth(p.s);
  if (is_outside() && p.s > range_.high) return axis_law_.azimuth(1 / (1 + p.s));
  return curve_.value(p.s);
}

double WhiteHoleTable::slope(const Place& place) const {
  const Place p = off_edge(place);
  if (p.s < curve_.x_min())
    return p.rate * (has_edge() ? edge_law_.slope(p.s) : axis_law_.slope(p.s));
  if (is_outside() && p.s > range_.high) {
    const double y = 1 / (1 + p.s);
    // d y/d alpha = -y^2 d s/d alpha is, on the axis itself, a product of 0 and infinity.
    const double by_alpha = std::isinf(p.s) ? 1 : y * y * std::abs(p.rate);
    return std::copysign(axis_law_.slope(y) * by_alpha, -p.rate);
  }
  return p.rate * curve_.at(p.s).first;
}

double WhiteHoleTable::place_of_azimuth(double phi) const {
  if (has_edge() && phi > edge_law_.azimuth(edge_law_.x_min)) return edge_law_.distance(phi);
  if (!has_axis() || phi >= axis_law_.azimuth(axis_law_.y_min))
    return curve_.inverse(phi, range_.high);
  const double y = axis_law_.distance(std::max(0.0, phi));
  return is_outside() ? (1 - y) / y : y;
}

WhiteHoleTable::Branches WhiteHoleTable::rays_of(double phi) const {
  Branches found;
  if (turn_ && (has_edge() ? phi < turn_->azimuth : phi > turn_->azimuth)) return found;
  const double s = place_of_azimuth(phi);
  found.ray[0] = ray_at_place(s);
  found.count = 1;
  if (!turn_) return found;
  found.ray[1] = other_half(s);
  found.count = 2;
  return found;
}

}  // namespace domefall
