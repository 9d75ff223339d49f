// The layers of a frame against its picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pipeline/render/rich_show.h"

namespace domefall {
namespace {

// What is 0 everywhere has no pixels.
double value_of(const std::vector<float>& values, std::size_t k) {
  return values.empty() ? 0 : values[k];
}
double value_of(const ImageRgb<float>& image, std::size_t k) { return value_of(image.pixels, k); }

// The picture that the layers make, by the formula that layer.h states.
double composed(LayeredFloatFrame& frame, std::size_t k) {
  double behind = 0;
  for (const Layer layer : {Layer::kSky, Layer::kStars, Layer::kDisc, Layer::kBodies})
    behind += value_of(frame.find(layer)->light, k);
  const LayerImage<float>& titles = *frame.find(Layer::kTitles);
  return value_of(titles.light, k) + (1 - value_of(titles.alpha, k / 3)) * behind;
}

template <class T>
double sum_of(const std::vector<T>& values) {
  double sum = 0;
  for (const T value : values) sum += value;
  return sum;
}

// Renders with all layers in floats, and expects the picture of a frame without layers.
LayeredFloatFrame expect_picture(const Show& show, int number = 0) {
  Renderer renderer(show, 2);
  const FrameState state = frame_state(show, number);
  LayeredFloatFrame frame(kAllLayers);
  renderer.render(state, frame);
  FloatImage alone;
  renderer.render(state, alone);
  EXPECT_EQ(alone.pixels, frame.picture.pixels);
  const float brightest = *std::ranges::max_element(alone.pixels);
  EXPECT_GT(brightest, 0);
  for (std::size_t k = 0; k < alone.pixels.size(); ++k) {
    const double sum = composed(frame, k);
    // Each layer is a difference of floats.
    if (std::abs(sum - alone.pixels[k]) > 1e-6 * (alone.pixels[k] + 0.1)) {
      ADD_FAILURE() << "pixel " << k / 3 << ": " << sum << " instead of " << alone.pixels[k];
      break;
    }
  }
  return frame;
}

TEST(Layers, MakeThePictureInEveryProjection) {
  for (const Projection& projection :
       {Projection(Domemaster{128}), Projection(Stereographic{120, 90, 1.8}),
        Projection(Equirectangular{160}), Projection(Cubemap{48})}) {
    LayeredFloatFrame frame = expect_picture(rich_show(projection));
    for (const LayerImage<float>& layer : frame.layers)
      EXPECT_GT(sum_of(layer.light.pixels), 0) << kind_of(layer.layer).name;
    EXPECT_GT(sum_of(frame.find(Layer::kDisc)->alpha), 0);
    EXPECT_GT(sum_of(frame.find(Layer::kTitles)->alpha), 0);
    EXPECT_EQ(sum_of(frame.find(Layer::kBodies)->alpha), 0);  // whose light only adds
    EXPECT_TRUE(frame.find(Layer::kSky)->alpha.empty());
  }
}

TEST(Layers, MakeThePictureWhileTheShutterIsOpenAndInFadesAndDissolves) {
  Show show = rich_show(Domemaster{96});
  show.exposure.shutter = 0.5;
  show.timeline[0].trajectory = CircularOrbit{8};
  show.timeline[0].timing.tau_end = ProperTime(40);
  show.frames_per_second = 10;
  Segment second = show.timeline[0];
  second.trajectory = StaticObserver{20};
  second.dissolve_s = 0.5;
  show.timeline.push_back(second);
  show.fades.in_s = 0.3;
  for (const int number : {1, 4, 7}) expect_picture(show, number);
}

// A compositor dims the disc, and nothing else changes.
TEST(Layers, OfADiscHoldItsLightAndWhatItHides) {
  Show show = rich_show(Domemaster{128});
  show.disc->opacity = 1;
  show.titles.clear();
  LayeredFloatFrame frame = expect_picture(show);
  const LayerImage<float>& disc = *frame.find(Layer::kDisc);
  Show without = show;
  without.disc.reset();
  without.bodies.clear();
  LayeredFloatFrame bare(kAllLayers);
  Renderer(without, 1).render(frame_state(without, 0), bare);
  int opaque = 0, clear = 0;
  for (std::size_t pixel = 0; pixel < disc.alpha.size(); ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t k = 3 * pixel + c;
      const double sky = value_of(frame.find(Layer::kSky)->light, k),
                   whole = value_of(bare.find(Layer::kSky)->light, k);
      ASSERT_NEAR(sky, whole * (1 - disc.alpha[pixel]), 1e-5 * (whole + 0.01)) << pixel;
      opaque += disc.alpha[pixel] == 1;
      clear += disc.alpha[pixel] == 0 && disc.light.pixels[k] == 0;
    }
  EXPECT_GT(opaque, 300);
  EXPECT_GT(clear, 300);
}

TEST(Layers, OfADiscThatACompositorDimsMakeThePictureOfADimmerOne) {
  Show show = rich_show(Domemaster{128});
  LayeredFloatFrame frame = expect_picture(show);
  constexpr float kPart = 2.0f / 3;
  for (float& value : frame.find(Layer::kDisc)->light.pixels) value *= kPart;
  show.timeline[0].curves[Channel::kDiscLuminance] = Curve{{{0, show.disc->luminance * kPart}}};
  FloatImage dimmed;
  Renderer(show, 1).render(frame_state(show, 0), dimmed);
  double most = 0;
  for (std::size_t k = 0; k < dimmed.pixels.size(); ++k) {
    ASSERT_NEAR(composed(frame, k), dimmed.pixels[k], 1e-6 * (dimmed.pixels[k] + 0.1)) << k / 3;
    most = std::max(most, std::abs(double{dimmed.pixels[k]} - frame.picture.pixels[k]));
  }
  EXPECT_GT(most, 0.1);
}

// What is not there costs nothing, and hides nothing.
TEST(Layers, OfADiscThatHasFadedAwayAreBlack) {
  Show show = rich_show(Domemaster{64});
  show.timeline[0].curves[Channel::kDiscOpacity] = Curve{{{0, 0}}};
  LayeredFloatFrame frame = expect_picture(show);
  EXPECT_EQ(sum_of(frame.find(Layer::kDisc)->light.pixels), 0);
  EXPECT_EQ(sum_of(frame.find(Layer::kDisc)->alpha), 0);
  EXPECT_FALSE(plan_frame(show, frame_state(show, 0)).disc);
}

TEST(Layers, OfBodiesHaveTheMagnitudeOfTheInstant) {
  Show show = rich_show(Domemaster{64});
  const auto light = [&show] {
    LayeredFloatFrame frame = expect_picture(show);
    return sum_of(frame.find(Layer::kBodies)->light.pixels);
  };
  const double before = light();
  show.timeline[0].magnitudes = {Curve{{{0, show.bodies[0].magnitude + 2.5}}}};
  EXPECT_NEAR(light() / before, 0.1, 1e-3);
}

TEST(Layers, ThatAreAskedForAloneAreTheSame) {
  const Show show = rich_show(Domemaster{128});
  const FrameState state = frame_state(show, 0);
  Renderer renderer(show, 2);
  LayeredHalfFrame all(kAllLayers);
  renderer.render(state, all);
  for (const Layer layer : kAllLayers) {
    LayeredHalfFrame one(std::vector{layer});
    renderer.render(state, one);
    ASSERT_EQ(one.layers.size(), 1U);
    EXPECT_EQ(one.layers[0].light.pixels, all.find(layer)->light.pixels) << kind_of(layer).name;
    EXPECT_EQ(one.layers[0].alpha, all.find(layer)->alpha);
  }
  // The alpha of the whole is that of the dome's circle.
  EXPECT_EQ(all.alpha[0], 0);
  EXPECT_EQ(all.alpha[64 * 128 + 64], 1);
  EXPECT_NEAR(sum_of(all.alpha) / (128.0 * 128), std::numbers::pi / 4, 0.01);
}

// The light of skies that are drawn as blobs belongs to them and not to stars.
TEST(Layers, OfSkiesHoldThoseThatAreSmallerThanAPixel) {
  Show show = show_of(RadialInfall{2 - 1e-6}, Domemaster{96});
  show.sky[SkyRegion::kIII].background = PanoramaSky{small_panorama()};
  show.timeline[0].camera.elevation = 90 * kDegree;
  LayeredFloatFrame frame = expect_picture(show);
  EXPECT_LT(sum_of(frame.find(Layer::kStars)->light.pixels),
            1e-6 * sum_of(frame.find(Layer::kSky)->light.pixels));
  EXPECT_GT(sum_of(frame.find(Layer::kSky)->light.pixels), 0);
}

}  // namespace
}  // namespace domefall
