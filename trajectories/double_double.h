// A DoubleDouble is a number kept as the sum of two doubles, with 32 digits.  hi is the sum
// rounded, and lo is what that leaves.  Proper times need it.  A fall from 1e9 M lasts 1.5e13 M,
// which a double holds to 2e-3 M, and at r = 1e-6 M only 5e-10 M of it are left.  Beside any
// double, here the end of the fall, a sum holds times to 16 digits of their distance from it.  The
// sums are those of Knuth, The Art of Computer Programming, vol. 2, sec. 4.2.2, theorem B.
#pragma once

#include <cmath>
#include <compare>

namespace domefall {

struct DoubleDouble {
  double hi = 0, lo = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}

  explicit constexpr operator double() const { return hi; }

  // NOLINTNEXTLINE(modernize-use-nullptr): the linter takes the compiler's 0 for a pointer.
  friend constexpr auto operator<=>(const DoubleDouble&, const DoubleDouble&) = default;
};

// Returns the exact sum of two doubles.  It is infinite or NaN as that of doubles is.
inline DoubleDouble exact_sum(double a, double b) {
  DoubleDouble sum(a + b);
  if (!std::isfinite(sum.hi)) return sum;
  const double of_b = sum.hi - a;
  sum.lo = (a - (sum.hi - of_b)) + (b - of_b);
  return sum;
}

// Returns the exact product of two doubles, unless it overflows or its last bits underflow.
inline DoubleDouble exact_product(double a, double b) {
  DoubleDouble product(a * b);
  if (std::isfinite(product.hi)) product.lo = std::fma(a, b, -product.hi);
  return product;
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  DoubleDouble negative(-a.hi);
  negative.lo = -a.lo;
  return negative;
}

// The relative error of the sum is below 1e-31 (Joldes, Muller and Popescu 2017, algorithm 6).
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exact_sum(a.hi, b.hi), low = exact_sum(a.lo, b.lo);
  const DoubleDouble sum = exact_sum(high.hi, high.lo + low.hi);
  return exact_sum(sum.hi, sum.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

using ProperTime = DoubleDouble;  // units of M; seconds in flat space

}  // namespace domefall
