// A ray's orbit obeys (dw/dpsi)^2 = P(w), where w = 1/r and P(w) = 1/b^2 - w^2 + 2 w^3 (M = 1).
// This file gives P and its roots in terms of x = w - 1/3 and eps = 1/b^2 - 1/27, in which
// P = 2 x^3 + x^2 + eps.  No difference of roots cancels, for the reason in exact_azimuth.h.
#pragma once

#include <cmath>
#include <numbers>

#include "pipeline/light/null_ray.h"

namespace domefall {

// Says whether a ray is as good as radial.  It is if L/|E| is so small that its square would leave
// the range of a double.
inline bool is_nearly_radial(const RayInvariants& k) {
  return k.angular_momentum < 1e-100 * std::abs(k.energy);
}

// A Cubic holds what the integral needs of a ray, which is 1/b^2 and eps, and the observer's place
// on the w axis.
struct Cubic {
  double inverse_b2, eps;
  double w, x;        // 1/r and 1/r - 1/3
  double p_observer;  // P(w) = (k^r/L)^2
};

inline Cubic cubic_of(const Radius& at, const RayInvariants& k) {
  const double l = k.angular_momentum;
  const double inverse_b = k.energy / l, radial = k.radial / l;
  return {inverse_b * inverse_b, (k.below_critical / l) * (k.above_critical / l), 1 / at.r,
          -at.above_light_circle / (3 * at.r), radial * radial};
}

// ---- eps >= 0: one real root, and a complex pair m +- i n in x ----

struct OneRealRoot {
  double m, n, root;  // all in x
};

// With z = 3 (x + 1/6) the equation P = 0 becomes z^3 - 3z/4 + (1 + 54 eps)/4 = 0.  It is solved by
// z = -cosh u with cosh 3u = 1 + 54 eps.
inline OneRealRoot one_real_root(double eps) {
  const double u = 2.0 / 3 * std::asinh(std::sqrt(27 * eps));
  const double half = std::sinh(u / 2);
  return {half * half / 3, std::sinh(u) / (2 * std::numbers::sqrt3), -std::cosh(u) / 3 - 1.0 / 6};
}

// ---- eps < 0: three real roots, w3 < 0 < w2 < 1/3 < w1 ----

struct RealRoots {
  double w1, w2, w3;
  double x1, x2;      // w1 - 1/3, w2 - 1/3
  double separation;  // w1 - w2
};

// Here z = -cos u, where cos 3u = 1 + 54 eps.  Near the double root the x are small and come from
// u.  Far from the hole (b large) w2 and w3 are small and come from the complement eta.
inline RealRoots real_roots(const Cubic& c) {
  const double u = 2.0 / 3 * std::atan2(std::sqrt(-c.eps), std::sqrt(c.inverse_b2));
  const double eta = std::atan2(std::sqrt(c.inverse_b2), std::sqrt(-c.eps)) / 3;
  const double s = std::sin(eta), k = std::cos(eta);
  const double su = std::sin(u / 2), cu = std::cos(u / 2);
  return {1.0 / 6 + std::cos(2 * eta) / 3,           s * (s / 3 + k / std::numbers::sqrt3),
          s * (s / 3 - k / std::numbers::sqrt3),     su * (cu / std::numbers::sqrt3 - su / 3),
          -su * (cu / std::numbers::sqrt3 + su / 3), 2 * su * cu / std::numbers::sqrt3};
}

}  // namespace domefall
