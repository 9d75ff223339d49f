// What a frame says of its pixels in numbers: mattes, identities, and the lens with the disc.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/lens_map.h"
#include "pipeline/render/pixel_probe.h"
#include "pipeline/sources/colour/colour_space.h"
#include "tests/pipeline/render/rich_show.h"
#include "trajectories/charged_orbit.h"

namespace domefall {
namespace {

LayeredFloatFrame with_mattes(Show show, int number = 0) {
  show.output.data.mattes = true;
  Renderer renderer(show, 2);
  LayeredFloatFrame frame(kAllLayers, mattes_of(show));
  renderer.render(frame_state(show, number), frame);
  return frame;
}

const std::vector<float>& matte(const LayeredFloatFrame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.mattes, name, &Matte::name);
  EXPECT_NE(found, frame.mattes.end()) << name;
  return found->covered;
}

// Orders of the disc are those parts of its alpha, and skies and silhouette fill the dome.
TEST(FrameMattes, AddUp) {
  for (const Projection& projection :
       {Projection(Domemaster{120}), Projection(Stereographic{96, 54, 2}),
        Projection(Cubemap{32})}) {
    LayeredFloatFrame frame = with_mattes(rich_show(projection));
    double second = 0;
    for (std::size_t k = 0; k < frame.alpha.size(); ++k) {
      double orders = 0;
      for (int order = 0; order < PlaneImages::kOrders; ++order)
        orders += matte(frame, "disc_" + std::to_string(order))[k];
      // Between its nodes the picture takes the alpha of one for that of all.
      ASSERT_NEAR(orders, frame.find(Layer::kDisc)->alpha[k], 1e-3) << k;
      second += matte(frame, "disc_1")[k];
      ASSERT_NEAR(matte(frame, "sky_I")[k] + matte(frame, "silhouette")[k], frame.alpha[k], 1e-6);
      ASSERT_EQ(matte(frame, "sky_III")[k], 0);
    }
    EXPECT_GT(second, 0);
  }
}

// On either side of the throat each sky's matte is where that sky is.
TEST(FrameMattes, KnowTheSkiesOnBothSidesOfAWormhole) {
  for (const double l : {2.0, -2.0}) {
    Show show = show_in_wormhole(l, Domemaster{64});
    const LayeredFloatFrame frame = with_mattes(show);
    const FrameState state = frame_state(show, 0);
    const ViewTracer tracer(state, WantedSkies{}, show.effects);
    for (int row = 4; row < 64; row += 4)
      for (int column = 4; column < 64; column += 4) {
        const PixelPosition at{column + 1.0, row + 1.0};
        if (!is_inside(state.projection, at)) continue;
        const ViewRay ray = tracer.trace(direction_at(state.projection, at));
        if (ray.to_edge < 0.1) continue;
        const auto k = static_cast<std::size_t>(64 * row + column);
        EXPECT_EQ(matte(frame, ray.sky == SkyRegion::kI ? "sky_I" : "sky_III")[k], 1) << l;
      }
  }
}

// In the next universe its sky stands around the hole, and that of the one before within.
TEST(FrameMattes, TellTheUniversesApart) {
  const ChargedHole hole(1, 0.9L);
  Show show = rich_show(Domemaster{120});
  show.disc.reset();
  show.bodies.clear();
  show.spacetime = hole;
  show.timeline[0].trajectory = ChargedOrbit::falling(hole, 9, 0, 0);
  show.timeline[0].timing = {0, 24};
  const LayeredFloatFrame before = with_mattes(show, 0), after = with_mattes(show, 29);
  const auto sum = [](const LayeredFloatFrame& frame, const char* name) {
    double total = 0;
    for (const float covered : matte(frame, name)) total += covered;
    return total;
  };
  EXPECT_GT(sum(before, "sky_I"), 0);
  EXPECT_EQ(sum(before, "sky_next"), 0);
  EXPECT_GT(sum(before, "silhouette"), 100);
  EXPECT_GT(sum(after, "sky_next"), sum(after, "sky_I"));
  EXPECT_GT(sum(after, "sky_I"), 100);
  EXPECT_LT(sum(after, "silhouette"), 0.2 * sum(before, "silhouette"));
  for (std::size_t k = 0; k < after.alpha.size(); ++k)
    ASSERT_NEAR(
        matte(after, "sky_I")[k] + matte(after, "sky_next")[k] + matte(after, "silhouette")[k],
        after.alpha[k], 1e-6);
}

// The silhouette's part of a pixel against 16 x 16 rays in it.
TEST(FrameMattes, AreAsSmoothAsThePicture) {
  for (const double r : {12.0, 1.4}) {
    Show show = rich_show(Domemaster{64});
    show.disc.reset();
    show.timeline[0].trajectory =
        GivenVelocity{r > 2 ? Region::kI : Region::kII, Tetrad::kRain, r, {0.1, 0.2, 0.1}};
    const LayeredFloatFrame frame = with_mattes(show);
    const FrameState state = frame_state(show, 0);
    const ViewTracer tracer(state, WantedSkies{{true, true, true}}, show.effects);
    int partial = 0;
    for (int row = 0; row < 64; ++row)
      for (int column = 0; column < 64; ++column) {
        if (!is_inside(state.projection, {column + 1.0, row + 1.0})) continue;
        PerSky<double> parts;
        for (int sample = 0; sample < 256; ++sample) {
          const PixelPosition at{column + 0.5 + (sample % 16 + 0.5) / 16,
                                 row + 0.5 + (sample / 16 + 0.5) / 16};
          parts[tracer.trace(direction_at(state.projection, at)).sky] += 1.0 / 256;
        }
        const auto k = static_cast<std::size_t>(64 * row + column);
        partial += parts[SkyRegion::kIV] > 0 && parts[SkyRegion::kIV] < 1;
        // A border counts as straight, and as far as in a square pixel turned to it.
        ASSERT_NEAR(matte(frame, "sky_I")[k], parts[SkyRegion::kI], 0.15) << r << ' ' << k;
        ASSERT_NEAR(matte(frame, "sky_III")[k], parts[SkyRegion::kIII], 0.15) << r << ' ' << k;
        ASSERT_NEAR(matte(frame, "silhouette")[k], parts[SkyRegion::kIV], 0.15) << r << ' ' << k;
      }
    EXPECT_GT(partial, 20) << r;
  }
}

// A body's part of the light gives its light back.
TEST(FrameMattes, HoldTheLightOfEachBody) {
  Show show = rich_show(Domemaster{128});
  Body other = show.bodies[0];
  other.trajectory = CircularOrbit{14};
  other.azimuth = 2;
  show.bodies.push_back(other);
  LayeredFloatFrame frame = with_mattes(show);
  show.bodies.pop_back();
  LayeredFloatFrame one = with_mattes(show);
  float most = 0;
  for (std::size_t k = 0; k < frame.alpha.size(); ++k) {
    const auto light = [&](LayeredFloatFrame& of, Layer layer) {
      const float* rgb = &of.find(layer)->light.pixels[3 * k];
      return luminance({rgb[0], rgb[1], rgb[2]});
    };
    double all = 0;
    for (const Layer layer : {Layer::kSky, Layer::kStars, Layer::kDisc, Layer::kBodies})
      all += light(frame, layer);
    const double own = light(one, Layer::kBodies);
    ASSERT_NEAR(matte(frame, "body_1")[k] * all, own, 1e-4 * all + 1e-6) << k;
    most = std::max(most, matte(frame, "body_2")[k]);
  }
  EXPECT_GT(most, 0.5F);
}

// With an open shutter, and in a dissolve, they are means like the light itself.
TEST(FrameMattes, AreMeansWhereTheLightIs) {
  Show show = rich_show(Domemaster{64});
  Show open = show;
  open.exposure.shutter = 1;
  open.timeline[0].trajectory = CircularOrbit{6};
  LayeredFloatFrame frame = with_mattes(open, 1);
  for (std::size_t k = 0; k < frame.alpha.size(); ++k) {
    double orders = 0;
    for (int order = 0; order < PlaneImages::kOrders; ++order)
      orders += matte(frame, "disc_" + std::to_string(order))[k];
    ASSERT_NEAR(orders, frame.find(Layer::kDisc)->alpha[k], 1e-3) << k;
  }
}

// The hashes are those that the author of the function published.
TEST(Cryptomatte, KnowsNamesByTheirHashes) {
  for (const auto& [name, hash] : {std::pair{"hello", 0x248bfa47u},
                                   {"hello, world", 0x149bbb7fu},
                                   {"The quick brown fox jumps over the lazy dog", 0x2e4ff723u}})
    EXPECT_EQ(std::bit_cast<std::uint32_t>(cryptomatte_id(name)), hash) << name;
  // The hash of nothing is 0, whose exponent would be that of a denormal.
  EXPECT_EQ(std::bit_cast<std::uint32_t>(cryptomatte_id("")), 0x00800000u);
}

TEST(Cryptomatte, RanksObjectsByTheirPart) {
  Cryptomatte objects(2, 1, {"a", "b", "c"});
  objects.add("a", {0.2f, 0});
  objects.add("b", {0.3f, 0.9f});
  objects.add_in_front("c", {0.5f, 0});
  const auto& pixels = objects.image().pixels;
  const float expected[] = {cryptomatte_id("c"),
                            0.5f,
                            cryptomatte_id("b"),
                            0.15f,
                            cryptomatte_id("a"),
                            0.1f,
                            0,
                            0,
                            cryptomatte_id("b"),
                            0.9f,
                            0,
                            0,
                            0,
                            0,
                            0,
                            0};
  for (std::size_t k = 0; k < pixels.size(); ++k) EXPECT_FLOAT_EQ(pixels[k], expected[k]) << k;
  EXPECT_EQ(objects.image().channels[4], "CryptoObject01.R");
}

// The lens map's disc is that of the probe.
TEST(LensMapOfADisc, IsTheProbes) {
  const Show show = rich_show(Domemaster{48});
  const FrameState state = frame_state(show, 0);
  const ChannelImage map = make_lens_map(show, state, 2);
  int gas = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) {
      const float* pixel = map.pixel(x, y);
      if (!is_inside(state.projection, {x + 1.0, y + 1.0})) continue;
      const auto disc = PixelProbe(show, state, {x + 1.0, y + 1.0}).disc();
      ASSERT_EQ(pixel[kGasCovered] > 0, !disc.empty());
      if (disc.empty()) continue;
      ++gas;
      EXPECT_FLOAT_EQ(pixel[kGasRadius], static_cast<float>(disc[0].r));
      EXPECT_FLOAT_EQ(pixel[kGasAzimuth], static_cast<float>(disc[0].azimuth_deg));
      EXPECT_FLOAT_EQ(pixel[kGasOnePlusZ], static_cast<float>(1 / disc[0].frequency_ratio));
      EXPECT_EQ(pixel[kGasOrder], disc[0].order);
    }
  EXPECT_GT(gas, 100);
}

}  // namespace
}  // namespace domefall
