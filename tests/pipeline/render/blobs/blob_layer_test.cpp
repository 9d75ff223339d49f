#include "pipeline/render/blobs/blob_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "pipeline/render/blobs/merged_caps.h"
#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

std::vector<StarImage> many_images(const Projection& p, int count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> x(0, static_cast<float>(columns(p))),
      y(0, static_cast<float>(rows(p))), light(-8, -5);
  std::vector<StarImage> images;
  for (int k = 0; k < count; ++k) {
    const float flux = std::pow(10.0f, light(random));
    images.push_back({x(random), y(random), {flux, flux, flux}});
  }
  return images;
}

// However images are divided among tasks, each is drawn as a whole, in every band that it reaches.
TEST(BlobLayer, DrawsTheSameHoweverItsImagesAreListed) {
  for (const Projection& p :
       {Projection(Domemaster{500}), Projection(Stereographic{300, 205, 1.5})}) {
    const Show show = show_of(StaticObserver{}, p);
    const PointSpread widths(show.point_spread, p, 1e3);
    const std::vector<StarImage> images = many_images(p, 400);
    BlobLayer whole(p), split(p), alone(p);
    whole.add(images, widths);
    std::vector<std::vector<StarImage>> lists, singles;
    for (std::size_t k = 0; k < images.size(); ++k) {
      if (k % 7 == 0) lists.emplace_back();
      lists.back().push_back(images[k]);
      singles.push_back({images[k]});
    }
    const auto add = [&](BlobLayer& layer, std::vector<std::vector<StarImage>> tasks) {
      const std::size_t first = layer.new_tasks(tasks.size());
      for (std::size_t t = 0; t < tasks.size(); ++t) layer.place(first + t, tasks[t], widths);
    };
    add(split, lists);
    add(alone, singles);
    for (BlobLayer* layer : {&whole, &split, &alone}) layer->sort_into_bands();
    EXPECT_EQ(whole.size(), split.size());
    const std::vector<float> expected = drawn(whole, p).rgb;
    EXPECT_EQ(drawn(split, p).rgb, expected);
    EXPECT_EQ(drawn(alone, p).rgb, expected);
    // The light of one star does not depend on the others.
    DrawnBlobs sum{p, std::vector<float>(expected.size())};
    for (const StarImage& image : images) {
      BlobLayer one(p);
      one.add(std::vector<StarImage>{image}, widths);
      one.sort_into_bands();
      draw_onto(sum, one);
    }
    for (std::size_t k = 0; k < expected.size(); ++k)
      if (sum.rgb[k] != expected[k]) {
        ASSERT_NEAR(sum.rgb[k], expected[k], 1e-5 * expected[k] + 1e-7) << k;
      }
  }
}

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
