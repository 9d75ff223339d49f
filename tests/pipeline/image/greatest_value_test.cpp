#include "pipeline/image/greatest_value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace domefall {
namespace {

TEST(GreatestValue, IsFoundAtEveryPlaceAndLength) {
  std::mt19937 random(7);
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<unsigned short> values(count), magnitudes(count);
    for (std::size_t k = 0; k < count; ++k) {
      values[k] = static_cast<unsigned short>(random());
      magnitudes[k] = values[k] & 0x7fff;
    }
    const auto most = [](const std::vector<unsigned short>& of) {
      return of.empty() ? 0 : *std::ranges::max_element(of);
    };
    EXPECT_EQ(greatest_value(values.data(), count), most(values)) << count;
    EXPECT_EQ(greatest_magnitude(values.data(), count), most(magnitudes)) << count;
  }
}

}  // namespace
}  // namespace domefall
