#include "pipeline/render/blobs/blob_layer.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace domefall
