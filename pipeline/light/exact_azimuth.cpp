#include "pipeline/light/exact_azimuth.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>

#include "pipeline/light/orbit_cubic.h"

namespace domefall {
namespace {

using boost::math::ellint_rf;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// ---- eps > 0: one real root, and a complex pair m +- i n in x ----

// The integral is 4/sqrt(2) R_F(M^2, L_-^2, L_+^2), with L_+-^2 = M^2 + 2 (m - root) +- 2 sqrt((m -
// root)^2 + n^2).  The lower one is found without cancellation.
double carlson(double m2, const OneRealRoot& p) {
  const double reach = p.m - p.root, far = std::hypot(reach, p.n);
  const double lower = m2 - 2 * p.n * p.n / (reach + far), upper = m2 + 2 * (reach + far);
  return 4 / std::sqrt(2.0) * ellint_rf(m2, lower, upper);
}

// This runs from w = 0 to the observer.
double from_infinity_without_turning(const Cubic& c) {
  const OneRealRoot p = one_real_root(c.eps);
  const double m = p.m, n = p.n, root = p.root;
  const double a = c.x - m, b = -1.0 / 3 - m;  // the ends, from the pair's real part
  const double xi = std::hypot(a, n), eta = std::hypot(b, n);
  // This is n^2 + ab + xi eta, which cancels when the double root lies between the ends.
  const double ab = a * b;
  const double mixed =
      ab >= 0 ? n * n + ab + xi * eta : n * n * (1 + (a * a + b * b + n * n) / (xi * eta - ab));
  const double linear = std::sqrt(c.x - root) + std::sqrt(-1.0 / 3 - root);
  const double m2 = 2 * mixed * (linear / c.w) * (linear / c.w);
  return carlson(m2, p);
}

// This runs from the observer to w = infinity, where M^2 = 2 (b + eta), b = x - m, eta = |b + i n|.
double to_singularity_without_turning(const Cubic& c) {
  const OneRealRoot p = one_real_root(c.eps);
  const double b = c.x - p.m, eta = std::hypot(b, p.n);
  return carlson(2 * (b >= 0 ? b + eta : p.n * p.n / (eta - b)), p);
}

// ---- eps < 0: three real roots, w3 < 0 < w2 < 1/3 < w1 ----

// Factors are (w - w3), (w2 - w), (w1 - w) of a point.  int dw/sqrt(P) follows for two points of
// which they are given.
struct Factors {
  double f1, f2, f3;
};
double carlson(const Factors& upper, const Factors& lower, double width) {
  if (width <= 0) return 0;
  const double x1 = std::sqrt(upper.f1), x2 = std::sqrt(upper.f2), x3 = std::sqrt(upper.f3);
  const double y1 = std::sqrt(lower.f1), y2 = std::sqrt(lower.f2), y3 = std::sqrt(lower.f3);
  const double u12 = (x1 * x2 * y3 + y1 * y2 * x3) / width;
  const double u13 = (x1 * x3 * y2 + y1 * y3 * x2) / width;
  const double u14 = (x1 * y2 * y3 + y1 * x2 * x3) / width;
  return std::sqrt(2.0) * ellint_rf(u12 * u12, u13 * u13, u14 * u14);
}

// Returns w2 - w.  The plain difference keeps its digits unless the observer is close to the
// turning point.  There P = 2 (w - w3)(w2 - w)(w1 - w) is known from k^r.
double below_turning_point(const Cubic& c, const RealRoots& w) {
  const double plain = c.w > 1.0 / 6 ? w.x2 - c.x : w.w2 - c.w;
  if (plain > 0.25 * std::min(c.w, std::abs(c.x))) return plain;
  return c.p_observer / (2 * (c.w - w.w3) * (w.x1 - c.x));
}

double from_infinity_outside_the_light_circle(const Cubic& c, bool turned) {
  const RealRoots w = real_roots(c);
  const Factors infinity{-w.w3, w.w2, w.w1};
  const Factors observer{c.w - w.w3, below_turning_point(c, w), w.x1 - c.x};
  if (!turned) return carlson(observer, infinity, c.w);
  const Factors turning{w.w2 - w.w3, 0, w.separation};
  return carlson(turning, infinity, w.w2) + carlson(turning, observer, observer.f2);
}

// Returns w - w1 likewise, for an observer inside the light circle.
double above_turning_point(const Cubic& c, const RealRoots& w) {
  const double plain = c.x - w.x1;
  if (plain > 0.25 * c.x) return plain;
  return c.p_observer / (2 * (c.w - w.w3) * (c.x - w.x2));
}

double to_singularity_inside_the_light_circle(const Cubic& c, bool turned) {
  const RealRoots w = real_roots(c);
  const double direct =
      std::sqrt(2.0) * ellint_rf(above_turning_point(c, w), c.x - w.x2, c.w - w.w3);
  if (!turned) return direct;
  return 2 * std::sqrt(2.0) * ellint_rf(0.0, w.separation, w.w1 - w.w3) - direct;
}

// ---- a ray as good as radial ----

double nearly_radial(const RayInvariants& k, double r, bool from_sky) {
  const double b = k.angular_momentum / std::abs(k.energy);
  if (from_sky) return b / r;
  // This is int b dr/sqrt(r^4 + 2 b^2 r) over all r.
  const double c = boost::math::beta(1.0 / 6, 1.0 / 3) / (3 * std::cbrt(2.0));
  return c * std::cbrt(b);
}

// Returns phi continued oddly through the axis, which a turned ray may have passed.
double continued_azimuth(NullRay ray) {
  const auto shift = [&](double by) {
    ray.gap_first += by * tan_half_critical(ray.at, Critical::kFirst);
    ray.gap_second += by * tan_half_critical(ray.at, Critical::kSecond);
  };
  if (ray.cos_half < 0) {
    shift(2 * ray.cos_half);
    ray.cos_half = -ray.cos_half;
    return -exact_azimuth(ray);
  }
  if (ray.sin_half < 0) {
    ray.gap_first -= 2 * ray.sin_half;
    ray.gap_second -= 2 * ray.sin_half;
    ray.sin_half = -ray.sin_half;
    return -exact_azimuth(ray);
  }
  return exact_azimuth(ray);
}

double edge_distance(const NullRay& ray, Critical edge) {
  const double gap = edge == Critical::kFirst ? ray.gap_first : ray.gap_second;
  return 2 * std::abs(gap) / std::hypot(1, tan_half_critical(ray.at, edge));
}

}  // namespace

double exact_azimuth(const NullRay& ray) {
  const RayInvariants k = invariants(ray);
  if (k.angular_momentum == 0) return 0;
  const bool from_sky = origin_of(ray) != SkyRegion::kIV;
  if (is_nearly_radial(k)) return nearly_radial(k, ray.at.r, from_sky);
  const Cubic c = cubic_of(ray.at, k);
  if (from_sky)
    return c.eps >= 0 ? from_infinity_without_turning(c)
                      : from_infinity_outside_the_light_circle(c, k.radial > 0);
  if (circles_for_ever(ray)) return kInfinite;
  return c.eps >= 0 ? to_singularity_without_turning(c)
                    : to_singularity_inside_the_light_circle(c, k.radial < 0);
}

EndAzimuths end_azimuths(const Cubic& c) {
  if (c.eps > 0) return {from_infinity_without_turning(c), to_singularity_without_turning(c)};
  const bool far = c.x < 0;
  if (c.eps == 0)
    return {far ? from_infinity_without_turning(c) : kInfinite,
            c.x > 0 ? to_singularity_without_turning(c) : kInfinite};
  return {far ? from_infinity_outside_the_light_circle(c, false) : kInfinite,
          far ? kInfinite : to_singularity_inside_the_light_circle(c, false)};
}

double smooth_over(const NullRay& ray) {
  const bool outside = ray.at.above_horizon > 0;
  const Critical own = ray.outgoing ? Critical::kSecond : Critical::kFirst;
  switch (origin_of(ray)) {
    case SkyRegion::kI:
      return edge_distance(ray, own);
    case SkyRegion::kIII:
      return edge_distance(ray, Critical::kSecond);
    case SkyRegion::kIV:
    case SkyRegion::kNext:
      break;
  }
  if (outside)
    return std::min(edge_distance(ray, own), 2 * (ray.outgoing ? ray.cos_half : ray.sin_half));
  if (ray.outgoing) return 2 * std::min(ray.sin_half, ray.cos_half);
  return std::min(edge_distance(ray, Critical::kFirst), edge_distance(ray, Critical::kSecond));
}

double exact_slope(const NullRay& ray) {
  const double h = 1e-3 * smooth_over(ray);
  const auto phi = [&](double steps) { return continued_azimuth(turned(ray, steps * h)); };
  return (8 * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12 * h);
}

}  // namespace domefall
