#include "pipeline/report/reference/reference_swept.h"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>

namespace domefall {
namespace {

using PanelRule = boost::math::quadrature::gauss<Real50, 15>;

template <class Function>
Real50 panel(const Function& function, const Real50& low, const Real50& high) {
  const Real50 middle = (low + high) / 2, half = (high - low) / 2;
  Real50 sum = 0;
  for (std::size_t k = 0; k < PanelRule::abscissa().size(); ++k) {
    const Real50 node = half * PanelRule::abscissa()[k];
    const Real50 both =
        node == 0 ? function(middle) : function(middle + node) + function(middle - node);
    sum += PanelRule::weights()[k] * both;
  }
  return sum * half;
}

// Returns the integral of a function of a distance from `least` (about 0) to `most`.  It is taken over
// the distance's root, in panels that double, since next to a place where a ray turns, or nearly circles,
// it has structure on every scale.
template <class Function>
Real50 over_distance(const Function& function, const Real50& least, const Real50& most) {
  const auto by_root = [&](const Real50& x) -> Real50 { return 2 * x * function(Real50(x * x)); };
  const Real50 end = sqrt(most);
  Real50 high = std::min(Real50(sqrt(least)), end), sum = panel(by_root, 0, high);
  while (high < end) {
    const Real50 low = high;
    high = std::min(Real50(2 * low), end);
    sum += panel(by_root, low, high);
  }
  return sum;
}

// ---- a charge ----

struct ChargedQuartic {
  Real50 q2, inverse_b2;

  Real50 potential(const Real50& w) const { return inverse_b2 - w * w * (1 - w * (2 - q2 * w)); }
  // Returns where P is least and, beyond, greatest: 1 - 3 w + 2 q^2 w^2 = 0.
  Real50 least_at() const { return 2 / (3 + sqrt(Real50(9 - 8 * q2))); }
  Real50 greatest_at() const { return (3 + sqrt(Real50(9 - 8 * q2))) / (4 * q2); }
  bool has_extremes() const { return 9 >= 8 * q2; }

  // Returns a root between two places where P has different signs.
  Real50 root(Real50 low, Real50 high) const {
    const bool rises = potential(low) < 0;
    for (int k = 0; k < 200; ++k) {
      const Real50 middle = (low + high) / 2;
      ((potential(middle) < 0) == rises ? low : high) = middle;
    }
    return low;
  }
  std::optional<Real50> next_root(const Real50& w) const {
    if (has_extremes() && w < least_at() && potential(least_at()) < 0) return root(w, least_at());
    if (q2 == 0) return std::nullopt;
    const Real50 from = has_extremes() ? std::max(w, greatest_at()) : w;
    Real50 beyond = 2 * from;
    while (potential(beyond) > 0) beyond *= 2;
    return root(from, beyond);
  }
  bool comes_from_sky(const Real50& w) const {
    return !(has_extremes() && w > least_at() && potential(least_at()) < 0);
  }

  // Returns the integral between two places that have no root between them, from both ends.
  Real50 between(const Real50& low, const Real50& high) const {
    const Real50 half = (high - low) / 2, least = half * Real50("1e-20");
    const auto from = [&](const Real50& end, int sign) {
      return over_distance(
          [&, sign](const Real50& d) -> Real50 { return 1 / sqrt(potential(end + sign * d)); },
          least, half);
    };
    return from(low, 1) + from(high, -1);
  }
  Real50 swept(const Real50& low, const Real50& high) const {
    if (has_extremes() && low < least_at() && least_at() < high)
      return between(low, least_at()) + between(least_at(), high);
    return low < high ? between(low, high) : Real50(0);
  }
};

// ---- a wormhole ----

struct ThroatIntegral {
  const WormholeShape& shape;
  Real50 b;

  // Returns r at a distance from the mouth of the throat.
  Real50 radius(const Real50& y) const {
    if (!shape.mass) return sqrt(Real50(1 + y * y));
    const Real50& m = *shape.mass;
    const Real50 x = 2 * y / (boost::math::constants::pi<Real50>() * m);
    return 1 + m * (x * atan(x) - log(Real50(1 + x * x)) / 2);
  }
  // Returns what is swept from one distance to another.  The least distance on which the integrand has
  // structure is that of the circle at the throat, or of the place where the ray turns.
  Real50 swept(const Real50& from, const Real50& to) const {
    const Real50 beyond = radius(from) - b, circle = abs(1 - b);
    const Real50 gap = beyond > circle * Real50("1e-20") ? std::min(beyond, circle) : circle;
    const Real50 width = shape.mass ? std::min(Real50(1), *shape.mass) : Real50(1);
    return over_distance(
        [&](const Real50& d) -> Real50 {
          const Real50 r = radius(from + d);
          return b / (r * sqrt(Real50((r - b) * (r + b))));
        },
        width* gap / 100, to - from);
  }
  // Where r differs from a distance by a part of 1e-9, what is left is the straight line's.
  Real50 swept_to_sky(const Real50& from) const {
    const Real50 far = Real50("1e12") * (1 + from + shape.mass.value_or(0));
    return swept(from, far) + b / far;
  }
  Real50 turns_at(const Real50& below) const {
    Real50 low = 0, high = below;
    for (int k = 0; k < 170; ++k) {
      const Real50 middle = (low + high) / 2;
      (radius(middle) < b ? low : high) = middle;
    }
    return high;
  }
};

}  // namespace

ChargedEdges charged_edges(const Real50& q, const Real50& r) {
  const Real50 q2 = q * q, circle = (3 + sqrt(Real50(9 - 8 * q2))) / 2;
  const Real50 kappa = circle * circle / sqrt(Real50(circle - q2));
  const Real50 x = (r - circle) *
                   sqrt(Real50(r * r + 2 * r * circle + circle * circle - kappa * kappa / circle));
  return {(r * r - x) / (kappa * r), (r * r + x) / (kappa * r)};
}

SweptAzimuth reference_charged_ray(const Real50& q, const Real50& r, const Real50& delta) {
  const Real50 sine = sin(Real50(delta / 2)), cosine = cos(Real50(delta / 2));
  const Real50 f = 1 - (2 - q * q / r) / r;
  const Real50 energy = sine * sine + f * cosine * cosine,
               radial = f * cosine * cosine - sine * sine;
  const Real50 inverse_b = energy / (2 * r * sine * cosine), w = 1 / r;
  const ChargedQuartic orbit{q * q, inverse_b * inverse_b};
  if (!orbit.comes_from_sky(w)) return {ReferenceSky::kNone};
  if (radial < 0)
    return {energy > 0 ? ReferenceSky::kOwn : ReferenceSky::kOther, orbit.swept(0, w)};
  const auto turn = orbit.next_root(w);
  if (!turn) return {ReferenceSky::kNone};
  // Light that turns at the core comes to who is inside r_- from his own sky, and to who is outside r_+
  // through the universe before.
  const bool through = q <= 1 && r > 1 && !(orbit.has_extremes() && *turn < orbit.least_at());
  return {through ? ReferenceSky::kEarlier : ReferenceSky::kOwn,
          orbit.swept(0, *turn) + orbit.swept(w, *turn)};
}

Real50 throat_angle(const WormholeShape& shape, const Real50& l) {
  const Real50 y = std::max(Real50(l - shape.half_length), Real50(0));
  return asin(Real50(1 / ThroatIntegral{shape, 0}.radius(y)));
}

SweptAzimuth reference_wormhole_ray(const WormholeShape& shape, const Real50& l,
                                    const Real50& delta) {
  const Real50 a = shape.half_length, y = std::max(Real50(l - a), Real50(0));
  ThroatIntegral orbit{shape, 0};
  orbit.b = orbit.radius(y) * sin(delta);
  // In the cylinder, where r = 1, the azimuth grows evenly.
  const Real50 slope = orbit.b / sqrt(Real50(abs((1 - orbit.b) * (1 + orbit.b))));
  const bool outwards = 2 * delta > boost::math::constants::pi<Real50>();
  if (!outwards && orbit.b < 1)
    return {ReferenceSky::kOther,
            orbit.swept(0, y) + orbit.swept_to_sky(0) + slope * (std::min(l, a) + a)};
  if (outwards)
    return {ReferenceSky::kOwn,
            orbit.swept_to_sky(y) + (l < a ? Real50(slope * (a - l)) : Real50(0))};
  const Real50 turn = orbit.turns_at(y);
  return {ReferenceSky::kOwn, orbit.swept(turn, y) + orbit.swept_to_sky(turn)};
}

}  // namespace domefall
