// Numbers that carry their derivatives along.
#pragma once

#include <cmath>

namespace domefall {

// A Dual is a value with its derivatives by two parameters.
struct Dual {
  double v = 0, d = 0, e = 0;

  Dual() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a number is a Dual that does not change.
  Dual(double value) : v(value) {}
  Dual(double value, double by_first, double by_second) : v(value), d(by_first), e(by_second) {}

  // Returns f(*this), given f and f' there.
  Dual chain(double f, double slope) const { return {f, slope * d, slope * e}; }
  Dual operator-() const { return {-v, -d, -e}; }
};

inline Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d, a.e + b.e}; }
inline Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d, a.e - b.e}; }
inline Dual operator*(const Dual& a, const Dual& b) {
  return {a.v * b.v, a.d * b.v + a.v * b.d, a.e * b.v + a.v * b.e};
}
inline Dual operator/(const Dual& a, const Dual& b) {
  const double over = 1 / b.v, q = a.v * over;
  return {q, (a.d - q * b.d) * over, (a.e - q * b.e) * over};
}
inline Dual operator+(const Dual& a, double b) { return {a.v + b, a.d, a.e}; }
inline Dual operator+(double a, const Dual& b) { return {a + b.v, b.d, b.e}; }
inline Dual operator-(const Dual& a, double b) { return {a.v - b, a.d, a.e}; }
inline Dual operator-(double a, const Dual& b) { return {a - b.v, -b.d, -b.e}; }
inline Dual operator*(const Dual& a, double b) { return {a.v * b, a.d * b, a.e * b}; }
inline Dual operator*(double a, const Dual& b) { return {a * b.v, a * b.d, a * b.e}; }
inline Dual operator/(const Dual& a, double b) { return a * (1 / b); }

inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.v);
  return a.chain(root, 0.5 / root);
}
inline Dual sin(const Dual& a) { return a.chain(std::sin(a.v), std::cos(a.v)); }
inline Dual cos(const Dual& a) { return a.chain(std::cos(a.v), -std::sin(a.v)); }
inline Dual atan2(const Dual& y, const Dual& x) {
  const double square = x.v * x.v + y.v * y.v;
  return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / square, (x.v * y.e - y.v * x.e) / square};
}
inline Dual asinh(const Dual& a) { return a.chain(std::asinh(a.v), 1 / std::hypot(1, a.v)); }

inline double value(double a) { return a; }
inline double value(const Dual& a) { return a.v; }

}  // namespace domefall
