#include "pipeline/render/blobs/blob_layer.h"

#include <gtest/gtest.h>

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

std::vector<float> drawn_layer(const BlobLayer& layer, const Projection& p) {
  const auto stride = static_cast<std::size_t>(columns(p)) * 3;
  const int bands = (rows(p) + kBandRows - 1) / kBandRows;
  std::vector<float> all(stride * static_cast<std::size_t>(kBandRows * bands) + 1);
  SplatBuffer buffer;
  layer.start_buffer(buffer);
  for (int band = 0; band < bands; ++band)
    layer.draw_band(band, buffer, all.data() + static_cast<std::size_t>(band * kBandRows) * stride);
  return all;
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
    const std::vector<float> expected = drawn_layer(whole, p);
    EXPECT_EQ(drawn_layer(split, p), expected);
    EXPECT_EQ(drawn_layer(alone, p), expected);
    // The light of one star does not depend on the others.
    std::vector<float> sum(expected.size());
    for (const StarImage& image : images) {
      BlobLayer one(p);
      one.add(std::vector<StarImage>{image}, widths);
      one.sort_into_bands();
      const std::vector<float> own = drawn_layer(one, p);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += own[k];
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
      ASSERT_NEAR(sum[k], expected[k], 1e-5 * expected[k] + 1e-7) << k;
  }
}

}  // namespace
}  // namespace domefall
