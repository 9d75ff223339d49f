#include "pipeline/simd/lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace domefall {
namespace {

TEST(Lanes, RepeatEachPixelForItsThreeChannels) {
  std::array<float, 16> pixels;
  for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<float>(k + 1);
  std::array<Lanes, 6> floats;
  repeat_for_channels<6>(pixels.data(), floats.data());
  for (std::size_t k = 0; k < 48; ++k) EXPECT_EQ(floats[k / 8][k % 8], pixels[k / 3]) << k;
}

TEST(Lanes, TheExponentialOfAFloatIsRightToThreeInAMillion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-80, 80);
  for (int k = 0; k < 200'000; ++k) {
    const float x = exponent(random) / static_cast<float>(k % 2 ? 1 : 40);
    ASSERT_NEAR(exponential_of_float(x) / std::exp(double{x}), 1, 3e-6) << x;
  }
  EXPECT_EQ(exponential_of_float(0), 1);
  EXPECT_EQ(exponential_of_float(-1e30f), exponential_of_float(-80));
}

}  // namespace
}  // namespace domefall
