#include "pipeline/render/shutter.h"

#include <gtest/gtest.h>

#include "pipeline/render/frame_key.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// For 30 frames the dome turns about its zenith by `degrees` a frame.
Show turning(double degrees, const Projection& projection) {
  Show show = show_of(StaticObserver{kFlatSpace}, projection);
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  show.timeline[0].camera.elevation = 90 * kDegree;
  show.timeline[0].curves[Channel::kRoll] =
      Curve{{{0, 0, Ease::kLinear}, {1, 30 * degrees * kDegree, Ease::kLinear}}};
  return show;
}

double light_of_frame(const HalfFrame& frame, const Projection& p) {
  double sum = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x)
      sum += frame.row(y)[3 * x + 1] * pixel_solid_angle(p, {x + 1.0, y + 1.0});
  return sum;
}

double brightest(const HalfFrame& frame) { return *std::ranges::max_element(frame.pixels); }

HalfFrame frame_numbered(const Show& show, int frame, StageTimes* times = nullptr) {
  return Renderer(show, 2).render(frame_state(show, frame), times);
}

TEST(Shutter, StreaksWithoutLosingLight) {
  const Projection p = Domemaster{512};
  Show show = turning(8, p);
  const HalfFrame still = frame_numbered(show, 10);
  show.exposure.shutter = 0.5;
  StageTimes times;
  const HalfFrame streaked = frame_numbered(show, 10, &times);
  // The rim is 256 pixels from the zenith, and a turn by 4 degrees moves it by 17.9 pixels.
  EXPECT_NEAR(times.instants, 17.9 / kPixelsPerInstant, 2);
  // A blob on the rim is cut off by its staircase of pixels, elsewhere at each instant.
  EXPECT_NEAR(light_of_frame(streaked, p) / light_of_frame(still, p), 1, 6e-3);
  EXPECT_LT(brightest(streaked), 0.6 * brightest(still));
}

// The mean of many more instants than the frame takes is the same.
TEST(Shutter, TakesAsManyInstantsAsTheMotionNeeds) {
  const Projection p = Domemaster{256};
  Show show = turning(6, p);
  show.exposure.shutter = 1;
  const HalfFrame streaked = frame_numbered(show, 10);
  Show instant = show;
  instant.exposure.shutter = 0;
  Renderer renderer(instant, 2);
  MeanFrame mean;
  LayeredHalfFrame whole;
  for (const FrameState& state : exposure_states(show, frame_state(show, 10), 200)) {
    renderer.render(state, whole);
    mean.add(whole);
  }
  mean.store(whole);
  const HalfFrame& reference = whole.picture;
  const double peak = brightest(reference);
  for (std::size_t k = 0; k < reference.pixels.size(); ++k)
    ASSERT_NEAR(streaked.pixels[k], reference.pixels[k], 0.01 * peak)
        << k / 3 % 256 << " " << k / 768;
}

TEST(Shutter, OfAStillViewTakesOneInstant) {
  Show show = turning(0, Domemaster{256});
  const HalfFrame closed = frame_numbered(show, 3);
  show.exposure.shutter = 1;
  StageTimes times;
  const HalfFrame open = frame_numbered(show, 3, &times);
  EXPECT_EQ(times.instants, 1);
  EXPECT_TRUE(std::equal(open.pixels.begin(), open.pixels.end(), closed.pixels.begin()));
}

// Of two segments that are seen at once the one that moves faster counts, even if it is the one
// that vanishes.
TEST(Shutter, OfADissolveTakesWhatTheFasterPartNeeds) {
  Show show = turning(8, Domemaster{256});
  Segment still = show.timeline[0];
  still.curves = {};
  still.dissolve_s = 0.5;
  show.timeline.push_back(still);
  show.exposure.shutter = 0.5;
  StageTimes times;
  frame_numbered(show, 20, &times);  // in the middle of the dissolve
  EXPECT_GT(times.instants, 5);
  frame_numbered(show, 40, &times);  // after the dissolve
  EXPECT_EQ(times.instants, 1);
}

TEST(Shutter, IsOpenAboutTheInstantAndNotAcrossACut) {
  Show show = turning(1, Domemaster{64});
  show.timeline.push_back(show.timeline[0]);
  show.exposure.shutter = 0.5;
  const auto states = exposure_states(show, frame_state(show, 10), 4);
  ASSERT_EQ(states.size(), 4u);
  const double frame = 1 / 30.0;
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(states[static_cast<std::size_t>(k)].show_time_s,
                10 * frame + (k - 1.5) / 4 * 0.5 * frame, 1e-12);
  for (const FrameState& state : exposure_states(show, frame_state(show, 30), 8)) {
    EXPECT_EQ(state.segment, 1);
    EXPECT_GE(state.show_time_s, 1.0);
  }
  for (const FrameState& state : exposure_states(show, frame_state(show, 59), 8))
    EXPECT_LE(state.show_time_s, 2.0);
}

TEST(Shutter, EntersTheKeysOfFrames) {
  Show show = turning(1, Domemaster{64}), faster = turning(2, Domemaster{64});
  const auto key = [](const Show& s) { return FrameKeys(s).scene(frame_state(s, 0)); };
  // At the first instant both cameras stand the same.
  EXPECT_EQ(key(show), key(faster));
  show.exposure.shutter = faster.exposure.shutter = 0.5;
  EXPECT_NE(key(show), key(faster));
  const std::string half = key(show);
  show.exposure.shutter = 0.25;
  EXPECT_NE(key(show), half);
}

}  // namespace
}  // namespace domefall
