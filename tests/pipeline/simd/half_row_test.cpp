#include "pipeline/simd/half_row.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace domefall {
namespace {

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
