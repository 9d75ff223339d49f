#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pipeline/base/simd/half_row.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/base/simd/vector_math.h"

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

TEST(HalfRow, RoundsAsHalfFloatsDo) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::uint32_t> bits(0, 0x477fe000);  // 0 to 65504
  std::vector<float> values{
      0, 1e-9f, 0x1p-24f, 0x1p-25f, 0x1.8p-24f, 0x1p-14f, 0.99999f * 0x1p-14f, 65504, 65519, 1e30f};
  while (values.size() < 100000) values.push_back(std::bit_cast<float>(bits(random)));
  // Every half, and the floats half way to the next ones.
  for (std::uint16_t k = 0; k < 0x7c00; ++k) {
    const float here = Imath::half(Imath::half::FromBits, k);
    const float step = std::max(0x1p-24f, std::ldexp(here, -10)) / 2;
    for (const float value : {here - step, here, here + step})
      if (value >= 0) values.push_back(value);
  }
  std::vector<std::uint16_t> out(values.size());
  ASSERT_TRUE(to_half(values.data(), static_cast<int>(values.size()), out.data()));
  for (std::size_t k = 0; k < values.size(); ++k)
    ASSERT_EQ(out[k], Imath::half(std::min(values[k], 65504.0f)).bits()) << values[k];
}

TEST(HalfRow, TellsOfValuesThatAreNotFinite) {
  std::uint16_t out[64];
  for (const float bad : {NAN, INFINITY, -INFINITY})
    for (int at : {0, 17, 63}) {
      std::vector<float> values(64, 1.0f);
      values[static_cast<std::size_t>(at)] = bad;
      EXPECT_FALSE(to_half(values.data(), 64, out));
    }
}

}  // namespace
}  // namespace domefall
