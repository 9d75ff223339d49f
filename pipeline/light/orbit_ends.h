// This file says how far an observer is from the ends of a ray's orbit, as exact_azimuth.cpp does,
// but without branches and without functions of a library, so that a loop over rays becomes SIMD
// code.
//
// The roots of P come from one equation, d (1 + 2 d)^2 = g.  With g = 2 eps it is that of the root
// -1/2 - d in x.  With g = -2/b^2 it is that of the root 1/2 + d in w.  All others follow from d by
// sums of equal signs.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace domefall::orbit_ends {

// CarlsonArguments stand for R_F(a, b, c) times a factor.
struct CarlsonArguments {
  double a, b, c, factor;
};

// An Orbit has the observer's place on it.
struct Orbit {
  double e, eps;   // |E|/L, e^2 - 1/27
  double w, x, p;  // of the observer; p = (k^r/L)^2
};

// Makes a step of Newton's method for d with d (1 + 2 d)^2 = g.
inline double refined_pair(double d, double g) {
  const double t = 1 + 2 * d;
  return d - (d * t * t - g) / (t * (1 + 6 * d));
}

// Returns that d for g >= 0.  It is reached from above, where the function is convex.
inline double complex_pair_root(double g) {
  // This is not less than the cube root of g/4.  The bits of a number are nearly its logarithm, and
  // 1/3 is 1/4 + 1/16 + 1/64 + ...
  const auto bits = std::bit_cast<std::uint64_t>(g + 1e-300);
  std::uint64_t third = (bits >> 2) + (bits >> 4);
  third += third >> 4;
  third += third >> 8;
  third += third >> 16;
  third += third >> 32;
  const double cube = 0.68 * std::bit_cast<double>(third + 0x2a9f7893782da1ce);
  const double d = refined_pair(refined_pair(g < cube ? g : cube, g), g);
  return refined_pair(refined_pair(refined_pair(refined_pair(d, g), g), g), g);
}

// Returns d with d (1 - 2 d)^2 = g, for 0 <= g <= 1/27.  It is reached from below, where the
// function is concave.
inline double real_pair_root(double g) {
  const double d = refined_pair(refined_pair(-g * (1 + 4 * g), -g), -g);
  return -refined_pair(refined_pair(d, -g), -g);
}

// For eps >= 0 the roots of P are -1/2 - delta and delta/2 +- i n in x.
struct ComplexPair {
  double delta, m, n2, reach, far;  // reach = m - root, far = |reach + i n|
};

inline ComplexPair complex_pair(double eps) {
  ComplexPair q{};
  q.delta = complex_pair_root(2 * eps);
  q.m = q.delta / 2;
  q.n2 = q.m * (1 + 3 * q.m);
  q.reach = 0.5 + 3 * q.m;
  q.far = std::sqrt(q.reach * q.reach + q.n2);
  return q;
}

inline CarlsonArguments of_pair(const ComplexPair& q, double m2) {
  return {m2, m2 - 2 * q.n2 / (q.reach + q.far), m2 + 2 * (q.reach + q.far),
          2 * std::numbers::sqrt2};
}

inline CarlsonArguments from_sky_over_pair(const ComplexPair& q, const Orbit& o) {
  const double a = o.x - q.m, b = -1.0 / 3 - q.m, ab = a * b;
  const double squares = a * a + b * b + q.n2;
  const double product = std::sqrt((a * a + q.n2) * (b * b + q.n2));
  const double mixed = ab >= 0 ? q.n2 + ab + product : q.n2 * (1 + squares / (product - ab));
  const double line = (std::sqrt(o.w + 1.0 / 6 + q.delta) + std::sqrt(1.0 / 6 + q.delta)) / o.w;
  return of_pair(q, 2 * mixed * line * line);
}

inline CarlsonArguments to_singularity_over_pair(const ComplexPair& q, const Orbit& o) {
  const double b = o.x - q.m, eta = std::sqrt(b * b + q.n2);
  return of_pair(q, 2 * (b >= 0 ? b + eta : q.n2 / (eta - b)));
}

// For eps < 0 P has three real roots, with w3 < 0 < w2 < 1/3 < w1.
struct RealTriple {
  double w1, w2, w3, x1, x2, separation;  // as RealRoots
  double below_half;                      // 1/2 - w1
};

inline RealTriple real_triple(double e, double eps) {
  // They come from d = 1/2 + x3 where the upper two roots are near each other, and from
  // d = 1/2 - w1 where the lower two are.
  constexpr double kHalfWay = 1.0 / 54;
  const bool upper = -eps < kHalfWay;
  const double d = real_pair_root(2 * (upper ? -eps : e * e));
  const double root = std::sqrt(d * (2 - 3 * d));
  RealTriple q{};
  q.x1 = upper ? (root - d) / 2 : 1.0 / 6 - d;
  q.x2 = upper ? -(root + d) / 2 : (root + d) / 2 - 1.0 / 3;
  q.w1 = q.x1 + 1.0 / 3;
  q.w2 = upper ? q.x2 + 1.0 / 3 : (root + d) / 2;
  q.w3 = upper ? d - 1.0 / 6 : (d - root) / 2;
  q.below_half = upper ? 1.0 / 6 - q.x1 : d;
  q.separation = upper ? root : q.w1 - q.w2;
  return q;
}

// Returns the arguments between two points by their distances from the roots, upwards from a sky.
inline CarlsonArguments between(double x1, double x2, double x3, double y1, double y2, double y3,
                                double width) {
  const double over = 1 / width;
  const double u12 = (x1 * x2 * y3 + y1 * y2 * x3) * over;
  const double u13 = (x1 * x3 * y2 + y1 * y3 * x2) * over;
  const double u14 = (x1 * y2 * y3 + y1 * x2 * x3) * over;
  return {u12 * u12, u13 * u13, u14 * u14, std::numbers::sqrt2};
}

inline CarlsonArguments from_sky_below_turn(const RealTriple& q, const Orbit& o) {
  const double plain = o.w > 1.0 / 6 ? q.x2 - o.x : q.w2 - o.w;
  const double depth = std::abs(o.x), share = 0.25 * (o.w < depth ? o.w : depth);
  const double below = plain > share ? plain : o.p / (2 * (o.w - q.w3) * (q.x1 - o.x));
  return between(std::sqrt(o.w - q.w3), std::sqrt(below), std::sqrt(q.x1 - o.x), std::sqrt(-q.w3),
                 std::sqrt(q.w2), std::sqrt(q.w1), o.w);
}

inline CarlsonArguments from_sky_to_turn(const RealTriple& q) {
  return between(std::sqrt(q.w2 - q.w3), 0, std::sqrt(q.separation), std::sqrt(-q.w3),
                 std::sqrt(q.w2), std::sqrt(q.w1), q.w2);
}

inline CarlsonArguments to_singularity_above_turn(const RealTriple& q, const Orbit& o) {
  const double plain = o.x - q.x1;
  const double above = plain > 0.25 * o.x ? plain : o.p / (2 * (o.w - q.w3) * (o.x - q.x2));
  return {above, o.x - q.x2, o.w - q.w3, std::numbers::sqrt2};
}

inline CarlsonArguments from_singularity_to_turn(const RealTriple& q) {
  return {0, q.separation, q.w1 - q.w3, std::numbers::sqrt2};
}

inline CarlsonArguments chosen(bool yes, const CarlsonArguments& a, const CarlsonArguments& b) {
  return {yes ? a.a : b.a, yes ? a.b : b.b, yes ? a.c : b.c, yes ? a.factor : b.factor};
}

// Returns R_F by duplication.  What is left after seven steps is below 0.01 of the mean even where
// the angle is 40 radians, and goes into the series to the seventh power (DLMF 19.36.1).  The error
// is below 1e-15.
inline double carlson_rf(double x, double y, double z) {
  for (int k = 0; k < 7; ++k) {
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double lambda = rx * (ry + rz) + ry * rz;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
  }
  const double a = (x + y + z) / 3;
  const double dx = 1 - x / a, dy = 1 - y / a, dz = -dx - dy;
  const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  const double series =
      1 + e2 * (-1.0 / 10 + e2 / 24 - 5 * e2 * e2 / 208 - 3 * e3 / 44 + e2 * e3 / 16) +
      e3 * (1.0 / 14 + 3 * e3 / 104);
  return series / std::sqrt(a);
}

}  // namespace domefall::orbit_ends
