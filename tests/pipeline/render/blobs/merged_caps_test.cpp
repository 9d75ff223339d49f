#include "pipeline/render/blobs/merged_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// What bounds the cost of a sky that shrinks to a few pixels leaves its image as it is.
TEST(MergedCaps, LookLikeTheirCapsDrawnOneByOne) {
  const Projection p = Domemaster{512};
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(-1.5f, 1.5f);
  std::vector<CapBlob> blobs;
  for (int k = 0; k < 4000; ++k) {
    CapBlob blob{300 + u(random), 200 + u(random), 0.04f, {1, 2, 3}, 0};
    ASSERT_TRUE(place_cap(p, blob));
    blobs.push_back(blob);
  }
  std::vector<CapBlob> merged = blobs;
  merge_crowds(p, merged);
  EXPECT_LT(merged.size(), 16u);
  const auto pixels_of = [&p](const std::vector<CapBlob>& some) {
    std::vector<float> rgb(512 * 512 * 3);
    const std::vector<ColumnRange> inside(8, {0, 511});
    for (int row = 0; row < 512; row += 8)
      for (const CapBlob& b : some)
        draw_cap(b, p, {rgb.data() + row * 512 * 3, 512, row, 8, inside.data()});
    return rgb;
  };
  const auto each = pixels_of(blobs), together = pixels_of(merged);
  const float peak = *std::max_element(each.begin(), each.end());
  for (std::size_t k = 0; k < each.size(); ++k)
    ASSERT_NEAR(each[k] / peak, together[k] / peak, 0.01) << k;
}

// Merged caps are brighter and reach farther, here than a very wide flat image does.
TEST(MergedCaps, StayWhereOneCapCannotBePlaced) {
  const Projection p = Stereographic{512, 512, 350 * kDegree};
  const auto placed = [&p](float x, float light) {
    CapBlob blob{x, 256, 0.1f, {light, light, light}, 0, 0, 0, 0, 0, 0};
    return std::pair(place_cap(p, blob), blob);
  };
  constexpr int kStars = 20;
  float x = 256;
  while (x < 512 && placed(x, 20 * kStars).first) ++x;
  ASSERT_TRUE(placed(x, 20).first);
  ASSERT_FALSE(placed(x, 20 * kStars).first);
  std::vector<CapBlob> blobs(kStars, placed(x, 20).second);
  merge_crowds(p, blobs);
  EXPECT_EQ(blobs.size(), kStars);
  // A crowd that can be placed becomes one.
  blobs.assign(kStars, placed(256, 20).second);
  merge_crowds(p, blobs);
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_EQ(blobs[0].rgb[0], 20 * kStars);
}

}  // namespace
}  // namespace domefall
