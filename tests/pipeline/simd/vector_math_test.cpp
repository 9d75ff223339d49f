#include "pipeline/simd/vector_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace domefall {
namespace {

TEST(VectorMath, SineAndCosineAreTheLibrarysToTheLastBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> sign(-1, 1), decades(-8, 5);
  for (int k = 0; k < 200'000; ++k) {
    const double x = std::pow(10, decades(random)) * (sign(random) < 0 ? -1 : 1);
    const SineCosine seen = sin_cos(x);
    ASSERT_NEAR(seen.sine, std::sin(x), 2.5e-16) << x;
    ASSERT_NEAR(seen.cosine, std::cos(x), 2.5e-16) << x;
  }
}

TEST(VectorMath, TheExponentialIsTheLibrarysAndVanishesFarDown) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-690, 690);
  for (int k = 0; k < 200'000; ++k) {
    const double x = exponent(random) / (k % 2 ? 1 : 100);
    ASSERT_NEAR(exponential(x) / std::exp(x), 1, 4e-16) << x;
  }
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-1e300), 0);
}

TEST(VectorMath, TheLogarithmIsTheLibrarysToTheLastBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-1022, 1023), near(0.5, 2);
  for (int k = 0; k < 200'000; ++k) {
    const double x = k % 2 ? std::exp2(exponent(random)) : near(random);
    const double expected = std::log(x);
    ASSERT_NEAR(logarithm(x), expected, 4e-16 * std::max(1.0, std::abs(expected))) << x;
  }
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_NEAR(logarithm(0x1p-1022), -1022 * std::numbers::ln2, 3e-13);
}

TEST(VectorMath, TheArcTangentIsTheLibrarysToTheLastBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> decades(-12, 12), sign(-1, 1);
  const auto number = [&] { return std::copysign(std::pow(10, decades(random)), sign(random)); };
  for (int k = 0; k < 200'000; ++k) {
    const double y = number(), x = k % 2 ? number() : y * (1 + 0.5 * sign(random));
    ASSERT_NEAR(arc_tangent2(y, x), std::atan2(y, x), 5e-16) << y << ' ' << x;
  }
  EXPECT_EQ(arc_tangent2(0, 0), 0);
  EXPECT_EQ(arc_tangent2(0, 3), 0);
  EXPECT_EQ(arc_tangent2(3, 0), std::numbers::pi / 2);
  EXPECT_EQ(arc_tangent2(0, -3), std::numbers::pi);
}

}  // namespace
}  // namespace domefall
