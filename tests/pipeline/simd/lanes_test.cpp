#include "pipeline/simd/lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace domefall {
namespace {

TEST(Lanes, RepeatEachPixelForItsThreeChannels) {
  std::array<float, 16> pixels;
  for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<float>(k + 1);
  std::array<Lanes, 6> floats;
  repeat_for_channels<6>(pixels.data(), floats.data());
  for (std::size_t k = 0; k < 48; ++k) EXPECT_EQ(floats[k / 8][k % 8], pixels[k / 3]) << k;
}

TEST(Lanes, TheExponentialOfAFloatIsRightToSomePartsInAMillion) {
  std::mt19937 random(1);
  for (const auto& [range, error] : {std::pair(20.0f, 5e-6), std::pair(80.0f, 8e-6)}) {
    std::uniform_real_distribution<float> exponent(-range, range);
    for (int k = 0; k < 200'000; ++k) {
      const float x = exponent(random);
      ASSERT_NEAR(exponential_of_float(x) / std::exp(double{x}), 1, error) << x;
    }
  }
  EXPECT_EQ(exponential_of_float(0), 1);
  EXPECT_EQ(exponential_of_float(-1e30f), exponential_of_float(-80));
}

TEST(Lanes, APowerOfTwoIsRightToThePrecisionOfAFloat) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-120, 120);
  for (int k = 0; k < 200'000; ++k) {
    const float x = exponent(random);
    ASSERT_NEAR(power_of_two(x) / std::exp2(double{x}), 1, 2e-7) << x;
  }
  EXPECT_EQ(power_of_two(0), 1);
  EXPECT_EQ(power_of_two(-3), 0.125f);
  EXPECT_EQ(power_of_two(-1e30f), power_of_two(-120));
}

TEST(Lanes, ABinaryLogarithmIsRightToThePrecisionOfAFloat) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-126, 127);
  for (int k = 0; k < 200'000; ++k) {
    const float x = std::exp2(exponent(random) / (k % 2 ? 1 : 40));
    const double exact = std::log2(double{x});
    ASSERT_NEAR(binary_logarithm(x), exact, 1.5e-7 * std::max(1.0, std::abs(exact))) << x;
  }
  for (int n = -126; n < 128; ++n) EXPECT_EQ(binary_logarithm(std::ldexp(1.0f, n)), n);
}

}  // namespace
}  // namespace domefall
