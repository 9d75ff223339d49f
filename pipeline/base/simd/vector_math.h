// These elementary functions have no branches, so that a loop over them becomes SIMD code.  They
// consist of IEEE additions, multiplications, divisions and selections, none of them fused.  So
// every machine gets the same bits, whatever the width of its vectors.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace domefall {

// Adding this to a number of absolute value below 2^51 rounds the number to an integer, which then
// stands in the lowest bits of the sum.
inline constexpr double kRounding = 6755399441055744.0;  // 1.5 * 2^52

struct SineCosine {
  double sine, cosine;
};

// Returns sine and cosine of |x| < 1e5 (radians).  Measured: the absolute error is below 2e-16.
//
// The multiple of pi/2 nearest to x is subtracted in three parts (Cody and Waite's reduction, with
// the constants of fdlibm).  The first two parts have 33 bits each, so that their multiples are
// exact.  The Taylor series of the rest, at most pi/4, are cut off where the next term is below
// 5e-17.
inline SineCosine sin_cos(double x) {
  constexpr double kFirst = 1.57079632673412561417e+00, kSecond = 6.07710050630396597660e-11,
                   kThird = 2.02226624879595063154e-21;
  const double shifted = x * 0.63661977236758134308 + kRounding;
  const double turns = shifted - kRounding;
  const auto quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double y = ((x - turns * kFirst) - turns * kSecond) - turns * kThird;
  const double t = y * y;
  constexpr std::array<double, 7> kSine{
      -1.0 / 6,        1.0 / 120,        -1.0 / 5040,         1.0 / 362880,
      -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000};
  constexpr std::array<double, 8> kCosine{
      -1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
      -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  double s = kSine[6], c = kCosine[7];
  for (int k = 5; k >= 0; --k) s = s * t + kSine[k];
  for (int k = 6; k >= 0; --k) c = c * t + kCosine[k];
  const double sine = y + y * t * s;
  const double cosine = 1 + t * c;
  // sin(y + pi/2) = cos y and cos(y + pi/2) = -sin y.  A half turn changes both signs.
  const bool swapped = (quadrant & 1) != 0;
  const double a = swapped ? cosine : sine;
  const double b = swapped ? sine : cosine;
  return {(quadrant & 2) != 0 ? -a : a, ((quadrant + 1) & 2) != 0 ? -b : b};
}

// Returns exp(x) for x <= 700, and 0 below -700.  Measured: the relative error is below 4e-16.
//
// With n = round(x / ln 2), exp(x) is 2^n times the Taylor series of exp(x - n ln 2).  n ln 2 is
// subtracted in two parts (fdlibm's), of which the first has so few bits that its multiple is
// exact.
inline double exponential(double x) {
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  const double bounded = x < -700 ? -700 : x;
  const double shifted = bounded * 1.44269504088896338700 + kRounding;
  const double n = shifted - kRounding;
  const double y = (bounded - n * kLn2High) - n * kLn2Low;
  constexpr std::array<double, 13> kOneOver{
      1.0 / 2,         1.0 / 6,          1.0 / 24,         1.0 / 120,     1.0 / 720,
      1.0 / 5040,      1.0 / 40320,      1.0 / 362880,     1.0 / 3628800, 1.0 / 39916800,
      1.0 / 479001600, 1.0 / 6227020800, 1.0 / 87178291200};
  double p = kOneOver[12];
  for (int k = 11; k >= 0; --k) p = p * y + kOneOver[k];
  const auto power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);
  return x < -700 ? 0 : (1 + (y + y * y * p)) * power;
}

// Returns ln x for finite x >= 2^-1022.  Measured: the error is below 4e-16 of max(1, |ln x|).
//
// Let x = 2^n m, with m between sqrt(1/2) and sqrt(2), and let s = (m - 1)/(m + 1).  Then
// ln x = n ln 2 + 2 artanh s.  The series of artanh is cut off where the next term is below 1e-17.
inline double logarithm(double x) {
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd, kMantissa = 0x000fffffffffffff;
  const auto bits = std::bit_cast<std::uint64_t>(x) - kRootHalf;
  // The exponent becomes a number by the reverse of kRounding's rule: it is put into the lowest
  // bits of kRounding, which is then subtracted.  By its 12 bits a negative exponent comes out 4096
  // too large, which is corrected below.
  const auto shifted =
      std::bit_cast<double>(((bits >> 52) + 1024) + std::bit_cast<std::uint64_t>(kRounding));
  const double n = shifted - kRounding;
  const double exponent = n > 2047 + 512 ? n - 4096 - 1024 : n - 1024;
  const auto m = std::bit_cast<double>((bits & kMantissa) + kRootHalf);
  const double s = (m - 1) / (m + 1), t = s * s;
  constexpr std::array<double, 10> kOdd{1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                        1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
  double p = kOdd[9];
  for (int k = 8; k >= 0; --k) p = p * t + kOdd[static_cast<std::size_t>(k)];
  return exponent * kLn2High + (exponent * kLn2Low + (2 * s + 2 * s * t * p));
}

// Returns the angle of the point (x, y), like std::atan2, for finite x and y, and 0 for (0, 0).
// Measured: the error is below 5e-16.
//
// Let t be the ratio of the smaller to the larger of |x| and |y|.  By the addition theorem
// atan t = pi/4 + atan((t - 1)/(t + 1)), which brings the argument below tan(pi/8).  As a function
// of t^2, (atan t - t)/t^3 is then replaced by the polynomial that interpolates it at Chebyshev's
// points.  This polynomial is right to 2e-19 of atan t.
inline double arc_tangent2(double y, double x) {
  constexpr double kQuarter = 0.78539816339744830962, kHalf = 1.57079632679489661923,
                   kPi = 3.14159265358979323846, kTanEighth = 0.41421356237309504880;
  constexpr std::array<double, 12> kSeries{
      -0.33333333333333333217,  0.19999999999999804526,   -0.14285714285659827606,
      0.11111111105155446565,   -0.090909087535008768438, 0.076922963750321423899,
      -0.066664248857382551943, 0.058789289978347737453,  -0.052304542706502354999,
      0.045515932206265123551,  -0.034570561981426890121, 0.016285756855220161234};
  const double ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
  const double low = ax < ay ? ax : ay, high = ax < ay ? ay : ax;
  const bool steep = low > kTanEighth * high;
  const double over = steep ? low - high : low, under = steep ? low + high : high;
  const double t = over / (under > 0 ? under : 1), z = t * t;
  double p = kSeries[11];
  for (int k = 10; k >= 0; --k) p = p * z + kSeries[k];
  const double octant = (steep ? kQuarter : 0) + (t + t * z * p);
  const double quadrant = ay > ax ? kHalf - octant : octant;
  const double half = x < 0 ? kPi - quadrant : quadrant;
  return y < 0 ? -half : half;
}

}  // namespace domefall
