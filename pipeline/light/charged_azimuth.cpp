#include "pipeline/light/charged_azimuth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace domefall {

using Long = long double;

ChargedView::ChargedView(const ChargedHole& hole, const ChargedRadius& at, bool outgoing)
    : hole_(hole),
      at_(at),
      outgoing_(outgoing),
      circle_(light_circle_of(hole.charge_long())),
      f_(hole.delta(at) / at.r / at.r) {
  if (!circle_.exists) return;
  inverse_kappa_ = 1 / hole.kappa();
  edges_ = hole.critical_tangents(at);
}

Long ChargedView::tan_half_critical(Critical edge) const {
  return edge == Critical::kFirst ? edges_.first : std::abs(edges_.second);
}

// This is |second| - first, which between the horizons is no difference of close numbers.
Long ChargedView::tangents_apart() const {
  return f_ < 0 ? -2 * at_.r * inverse_kappa_ : edges_.apart;
}

Long ChargedView::between_edges() const {
  return 2 * std::atan2(std::abs(tangents_apart()), 1 + std::abs(f_));
}

ChargedRay ChargedView::completed(Long sine, Long cosine, Long gap, Critical edge) const {
  const bool first = edge == Critical::kFirst;
  // The far end of the view (alpha = pi or 0) is an end that rounding may not step over.
  ChargedRay ray{std::max(Long{0}, sine), std::max(Long{0}, cosine), gap, gap};
  if (!has_edges()) return ray;
  const Long apart = (first ? -tangents_apart() : tangents_apart()) * ray.cos_half;
  const Long reach = tan_half_critical(first ? Critical::kSecond : Critical::kFirst) * ray.cos_half;
  const bool direct = std::max(ray.sin_half, reach) < std::max(std::abs(gap), std::abs(apart));
  (first ? ray.gap_second : ray.gap_first) = direct ? ray.sin_half - reach : gap + apart;
  return ray;
}

ChargedRay ChargedView::ray_at(const PolarAngle& alpha) const {
  const bool small = alpha.angle < alpha.rest;
  const Long sine = small ? std::sin(alpha.angle / 2) : std::cos(alpha.rest / 2);
  const Long cosine = small ? std::cos(alpha.angle / 2) : std::sin(alpha.rest / 2);
  if (!has_edges()) return completed(sine, cosine, 0, Critical::kFirst);
  // Angles are taken from whichever end of the half turn is nearer.
  const auto gap = [&](Critical edge) {
    const Long tangent = tan_half_critical(edge);
    return std::sin(small ? alpha.angle / 2 - std::atan(tangent)
                          : std::atan(1 / tangent) - alpha.rest / 2) *
           std::hypot(Long{1}, tangent);
  };
  const Long one = gap(Critical::kFirst), two = gap(Critical::kSecond);
  return std::abs(one) <= std::abs(two) ? completed(sine, cosine, one, Critical::kFirst)
                                        : completed(sine, cosine, two, Critical::kSecond);
}

ChargedRay ChargedView::ray_off_edge(Critical edge, double offset) const {
  const Long tangent = tan_half_critical(edge);
  const Long c = 1 / std::sqrt(1 + tangent * tangent), s = tangent * c;
  const Long so = std::sin(Long{offset} / 2), co = std::cos(Long{offset} / 2);
  return completed(s * co + c * so, c * co - s * so, so / c, edge);
}

Long ChargedView::energy(const ChargedRay& ray) const {
  const Long s = ray.sin_half, c = ray.cos_half;
  if (f_ >= 0 || !has_edges()) return s * s + f_ * c * c;
  // Where that cancels, both terms of (E - L/kappa) + (E + L/kappa) have the sign of E.
  const Long first = tan_half_critical(Critical::kFirst) * c;
  const Long second = tan_half_critical(Critical::kSecond) * c;
  return (ray.gap_first * (s + second) + ray.gap_second * (s + first)) / 2;
}

Long ChargedView::below_critical(const ChargedRay& ray) const {
  const Long s = ray.sin_half, c = ray.cos_half;
  if (!circle_.exists) {
    const Long e = energy(ray);
    return e * e;
  }
  if (has_edges())
    return ray.gap_first * ray.gap_second * (s + tan_half_critical(Critical::kFirst) * c) *
           (s + tan_half_critical(Critical::kSecond) * c);
  // The four roots are +-first +- i apart/2.
  const auto square = [](Long x) { return x * x; };
  const Long side = square(edges_.apart * c / 2), middle = edges_.first * c;
  return (square(s - middle) + side) * (square(s + middle) + side);
}

// Next to the circle of light sqrt(f) cos - sin, where light turns, is made from the gap.
Long ChargedView::radial(const ChargedRay& ray) const {
  const Long s = ray.sin_half, c = ray.cos_half;
  Long inward = f_ * c * c - s * s;
  if (f_ > 0 && has_edges()) {
    const Long first = std::sqrt(edges_.first), second = std::sqrt(edges_.second);
    const Long turning = edges_.apart * first / (first + second) * c;
    const Long root = std::sqrt(f_) * c;
    if (std::max(std::abs(turning), std::abs(ray.gap_first)) < std::max(root, s))
      inward = (turning - ray.gap_first) * (root + s);
  }
  return outgoing_ ? -inward : inward;
}

ChargedOrigin ChargedView::origin_of(const ChargedRay& ray) const {
  const Long below = below_critical(ray), inward = radial(ray);
  if (below <= 0) {
    const bool free = at_.above_light_circle > 0 && (below < 0 || inward < 0);
    return free ? ChargedOrigin::kOwn : ChargedOrigin::kDark;
  }
  const bool positive = energy(ray) > 0;
  if (inward < 0) return positive ? ChargedOrigin::kOwn : ChargedOrigin::kParallel;
  if (hole_.charge == 0) return ChargedOrigin::kDark;
  if (hole_.is_naked() || at_.above_inner < 0) return ChargedOrigin::kOwn;
  return positive ? ChargedOrigin::kBefore : ChargedOrigin::kParallelBefore;
}

double ChargedView::azimuth(const ChargedRay& ray) const {
  if (origin_of(ray) == ChargedOrigin::kDark) return std::numeric_limits<double>::infinity();
  const Long l = 2 * at_.r * ray.sin_half * ray.cos_half;
  if (l == 0) return 0;
  const Long inward = radial(ray), k = inward / l, w = 1 / Long{at_.r};
  const Long above_circle = circle_.exists ? -at_.above_light_circle * w * circle_.w : w;
  const Long below = below_critical(ray);
  const OrbitQuartic orbit(circle_, std::abs(energy(ray)) / l, below / l / l, w, above_circle,
                           k * k);
  return static_cast<double>(inward < 0 ? orbit.direct() : orbit.turned());
}

}  // namespace domefall
