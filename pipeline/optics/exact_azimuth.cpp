#include "pipeline/optics/exact_azimuth.h"

#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>

namespace domefall {
namespace {

using boost::math::ellint_rf;

const double kSqrt3 = std::sqrt(3.0);

// What the integral needs of a ray: 1/b^2 and eps, and the observer's place on the w axis.
struct Cubic {
  double inverse_b2, eps;
  double w, x;        // 1/r and 1/r - 1/3
  double p_observer;  // P(w) = (k^r/L)^2
};

Cubic cubic_of(const Radius& at, const RayInvariants& k) {
  const double l2 = k.angular_momentum * k.angular_momentum;
  return {k.energy * k.energy / l2, k.below_critical * k.above_critical / l2, 1 / at.r,
          -at.above_light_circle / (3 * at.r), k.radial * k.radial / l2};
}

// ---- eps > 0: one real root, and a complex pair m +- i n in x ----

// With z = 3 (x + 1/6), z^3 - 3z/4 + (1 + 54 eps)/4 = 0 and z = -cosh u, cosh 3u = 1 + 54 eps.
double from_infinity_without_turning(const Cubic& c) {
  const double u = 2.0 / 3 * std::asinh(std::sqrt(27 * c.eps));
  const double half = std::sinh(u / 2);
  const double m = half * half / 3, n = std::sinh(u) / (2 * kSqrt3);
  const double root = -std::cosh(u) / 3 - 1.0 / 6;  // the real one, in x
  const double a = c.x - m, b = -1.0 / 3 - m;       // the ends, from the pair's real part
  const double xi = std::hypot(a, n), eta = std::hypot(b, n);
  // n^2 + ab + xi eta, which cancels when the double root lies between the ends.
  const double ab = a * b;
  const double mixed =
      ab >= 0 ? n * n + ab + xi * eta : n * n * (1 + (a * a + b * b + n * n) / (xi * eta - ab));
  const double linear = std::sqrt(c.x - root) + std::sqrt(-1.0 / 3 - root);
  const double m2 = 2 * mixed * (linear / c.w) * (linear / c.w);
  // L_+-^2 = M^2 + 2 (m - root) +- 2 sqrt((m - root)^2 + n^2), the lower one without cancellation.
  const double reach = m - root, far = std::hypot(reach, n);
  const double lower = m2 - 2 * n * n / (reach + far), upper = m2 + 2 * (reach + far);
  return 4 / std::sqrt(2.0) * ellint_rf(m2, lower, upper);
}

// ---- eps < 0: three real roots, w3 < 0 < w2 < 1/3 < w1 ----

struct RealRoots {
  double w1, w2, w3;
  double x1, x2;      // w1 - 1/3, w2 - 1/3
  double separation;  // w1 - w2
};

// z = -cos u: cos 3u = 1 + 54 eps.  Near the double root the x are small and come from u; far from
// the hole (b large) w2 and w3 are small and come from the complement eta.
RealRoots real_roots(const Cubic& c) {
  const double u = 2.0 / 3 * std::atan2(std::sqrt(-c.eps), std::sqrt(c.inverse_b2));
  const double eta = std::atan2(std::sqrt(c.inverse_b2), std::sqrt(-c.eps)) / 3;
  const double s = std::sin(eta), k = std::cos(eta);
  const double su = std::sin(u / 2), cu = std::cos(u / 2);
  return {1.0 / 6 + std::cos(2 * eta) / 3, s * (s / 3 + k / kSqrt3),     s * (s / 3 - k / kSqrt3),
          su * (cu / kSqrt3 - su / 3),     -su * (cu / kSqrt3 + su / 3), 2 * su * cu / kSqrt3};
}

// int dw/sqrt(P) between two points whose factors (w - w3), (w2 - w), (w1 - w) are given.
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

// w2 - w.  The plain difference keeps its digits unless the observer is close to the turning point;
// there P = 2 (w - w3)(w2 - w)(w1 - w) is known from k^r.
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

}  // namespace

double exact_azimuth(const NullRay& ray) {
  const RayInvariants k = invariants(ray);
  if (k.angular_momentum == 0) return 0;
  const Cubic c = cubic_of(ray.at, k);
  if (c.eps >= 0) return from_infinity_without_turning(c);
  return from_infinity_outside_the_light_circle(c, k.radial > 0);
}

}  // namespace domefall
