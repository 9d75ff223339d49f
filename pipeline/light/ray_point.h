// This file finds the point of an orbit at an angle from one of its ends, without branches, so that
// a loop over rays becomes SIMD code.  It uses x = w - 1/3, w = 1/r, where (dw/dpsi)^2 = P = 2 x^3
// + x^2 + eps (orbit_cubic.h).  The angle from the singularity is doubled by
//
//     x <- (x^4 - (4 x + 1) eps)/(2 P),
//     |x'| <- (x^6 + x^5 + 5 eps x^2 (2 x + 1) + eps x - 2 eps^2)/(2 P^(3/2)).
//
// This is the duplication of Weierstrass's P.  A small angle begins with P's Laurent series.
#pragma once

#include <cmath>

namespace domefall {

struct RayPoint {
  double w, speed;  // 1/r, and |dw/dpsi|
};

// Returns x at twice the angle from the singularity.
inline double x_at_twice(double x, double eps) {
  const double x2 = x * x;
  return (x2 * x2 - (4 * x + 1) * eps) / (2 * (x2 * (2 * x + 1) + eps));
}

// A DoublingStart is what the doubling begins with, x and |x'| by the series at z.  Here z is sigma
// itself where that is short by the orbit's own measure, min(1, b^(1/3)), and sigma/128 elsewhere.
struct DoublingStart {
  double z, is_short;  // is_short: 1 or 0
  double x, speed;
};

inline DoublingStart doubling_start(double inverse_b, double eps, double sigma) {
  constexpr double kShare = 1.0 / 128, kFarthest = 40, kShort = 0.25;
  const double far = sigma < kFarthest ? sigma : kFarthest;
  const double by_size = far / kShort, by_b = inverse_b * (by_size * by_size * by_size);
  const double is_short = (by_size > by_b ? by_size : by_b) < 1 ? 1 : 0;
  const double z = is_short > 0 ? far : far * kShare, z2 = z * z;
  // P(z) = 1/z^2 + c2 z^2 + c3 z^4 + ..., with g2 = 1/12 and g3.
  const double g3 = -1.0 / 216 - eps / 4;
  constexpr double kC2 = 1.0 / 240, kC4 = kC2 * kC2 / 3;
  const double c3 = g3 / 28, c5 = 3 * kC2 * c3 / 11, c6 = (2 * kC2 * kC4 + c3 * c3) / 13;
  const double rest = kC2 + z2 * (c3 + z2 * (kC4 + z2 * (c5 + z2 * c6)));
  const double slope = 2 * kC2 + z2 * (4 * c3 + z2 * (6 * kC4 + z2 * (8 * c5 + z2 * 10 * c6)));
  const double over = 1 / z2;
  return {z, is_short, 2 * over + (2 * z2 * rest - 1.0 / 6), (4 * over - 2 * z2 * slope) / z};
}

// Returns the point at twice the angle of x.
inline RayPoint point_at_twice(double x, double eps) {
  const double x2 = x * x, twice = 2 * x + 1, p = x2 * twice + eps, half = 0.5 / p;
  const double rise = x2 * x2 * x * (x + 1) + eps * (5 * x2 * twice + x - 2 * eps);
  return {(x2 * x2 - (4 * x + 1) * eps) * half + 1.0 / 3, rise * half / std::sqrt(p)};
}

// Returns the point at the angle sigma > 0 from the singularity, up to half of the way to the other
// end.  Where the orbit comes near to the light circle for ever, it is there from 40 radians on.
// inverse_b = |E|/L is below 1e40, and eps = inverse_b^2 - 1/27 has its own digits.  Measured
// against orbits integrated with 40 digits, the relative error of w is below 1e-15 beside what an
// error of sigma makes of it.
inline RayPoint point_from_singularity(double inverse_b, double eps, double sigma) {
  const DoublingStart start = doubling_start(inverse_b, eps, sigma);
  double x = x_at_twice(x_at_twice(start.x, eps), eps);
  x = x_at_twice(x_at_twice(x, eps), eps);
  x = x_at_twice(x_at_twice(x, eps), eps);
  const RayPoint last = point_at_twice(x, eps);
  const bool is_short = start.is_short > 0;
  return {is_short ? start.x + 1.0 / 3 : last.w, is_short ? start.speed : last.speed};
}

// A SkyPoint is the point at the angle rho > 0 from a sky.  By the addition theorem, with
// e = inverse_b > 0,
//     w = e (e + s')/s^2,   |dw/dpsi| = e (1 - (1 - 2 w)/s)
// with s and s' of the point as far from the singularity.
struct SkyPoint {
  double r;
  double speed;  // |dw/dpsi|
};
inline SkyPoint point_from_sky(double inverse_b, const RayPoint& s) {
  const double e = inverse_b, r = s.w / e * (s.w / (e + s.speed));
  return {r, e * (1 - (1 - 2 / r) / s.w)};
}

}  // namespace domefall
