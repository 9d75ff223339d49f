// Bodies that move while a frame's light is gathered.
#include "pipeline/render/body_trail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/stars/star_trail.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/pipeline/show/show_file.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A static observer at 30 M sees a body in a circular orbit at 8 M, whose plane holds the observer
// or passes so many radians beside.  The show has one segment of 100 frames.
Show show_with(double azimuth, double beside, double m_per_frame, double radius, int frame = 50) {
  Show show = show_of(StaticObserver{30}, Stereographic{401, 401, 60 * kDegree});
  show.spacetime = Schwarzschild{4e6};
  show.frames_per_second = 50;
  show.timeline[0].duration_s = 2;
  show.timeline[0].timing = {0, 100 * m_per_frame};
  show.timeline[0].camera.attitude = LookAtHole{};
  show.point_spread.min_sigma = 0.4 * kDegree;
  show.point_spread.max_sigma = 0.5 * kDegree;
  const FrameState state = frame_state(show, 0);
  const M33d& axes = state.observer.sky_from_tetrad;
  Body body;
  body.trajectory = CircularOrbit{8};
  body.node = {column(axes, 0) * std::cos(beside) + column(axes, 1) * std::sin(beside)};
  body.normal = {column(axes, 0) * std::sin(beside) - column(axes, 1) * std::cos(beside)};
  body.magnitude = -5;
  body.radius = radius;
  // It is seen at this azimuth in that frame.
  const auto place = image_of_place({30, false, false}, 8, azimuth, 0);
  const double null_time = frame_state(show, frame).observer.null_time;
  body.azimuth = azimuth - std::pow(8, -1.5) * (place->null_time + null_time);
  show.bodies = {body};
  return show;
}

std::vector<StarImage> images(const Show& show, const FrameState& state, const BodyTimes& times) {
  const FramePlan plan = plan_frame(show, state);
  const FrameScene scene(show, state, plan, lens_of(state.observer, plan.wanted(), show.effects),
                         {}, {}, nullptr, times);
  std::vector<StarImage> all;
  for (const BodyImages& drawn : images_of_bodies(scene, scene.bodies, nullptr))
    all.insert(all.end(), drawn.light.begin(), drawn.light.end());
  return all;
}

double light(const std::vector<StarImage>& images) {
  double sum = 0;
  for (const StarImage& image : images) sum += image.rgb[1];
  return sum;
}

// Returns the mean light of instants over a window, by Simpson's rule in steps that follow a
// substitution u = sinh: passages are brief.
template <class Weight>
double mean_light(const Show& show, int frame, double half, double finest, const Weight& weight) {
  const FrameState state = frame_state(show, frame);
  constexpr int kSteps = 240;
  const double end = std::asinh(half / finest);
  double sum = 0, weights = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double x = end * (2.0 * k / kSteps - 1), u = finest * std::sinh(x);
    FrameState then = state;
    then.observer = observer_after(show, state, u, CameraMotion::kStays);
    const double part =
        std::cosh(x) * weight(std::abs(u) / half) * (k == 0 || k == kSteps ? 1 : 2 + 2 * (k % 2));
    sum += part * light(images(show, then, {}));
    weights += part;
  }
  return sum / weights;
}

TEST(BodyTrails, HaveTheLightOfTheTimeThatTheShutterIsOpen) {
  const Show show = show_with(2, 0, 2, 0.05);
  const FrameState state = frame_state(show, 50);
  const std::vector<StarImage> streak = images(show, state, body_times(show, state, 0.5));
  EXPECT_GT(streak.size(), 10u);
  const double mean = mean_light(show, 50, 0.25, 0.25, [](double) { return 1; });
  EXPECT_NEAR(light(streak) / mean, 1, 1e-3);
}

TEST(BodyTrails, BehindTheHoleHaveTheLightOfTheirWindow) {
  for (const double beside : {0.0, 0.01, 0.1}) {
    constexpr double kPerFrame = 0.5;
    const Show show = show_with(pi, beside, kPerFrame, 0.1);
    const FrameState state = frame_state(show, 50);
    const std::vector<StarImage> ring = images(show, state, body_times(show, state, 0));
    // The orbit's time runs as much faster than that of who is at rest at 30 M as he is lower.
    const double way = std::pow(8, -1.5) * kPerFrame / std::sqrt(1 - 2 / 30.0);
    const PassageWindow window = passage_window(std::sin(beside) / way, kFarthestPassage / way);
    const double mean = mean_light(show, 50, window.half, 0.05, [&](double u) {
      return std::pow(std::max(0.0, 1 - u), window.sharpness);
    });
    EXPECT_NEAR(light(ring) / mean, 1, 1e-3) << beside << " " << ring.size();
  }
}

// Where the window would reach beyond the segment, a passage is as bright as elsewhere, but for what the
// speed of the body makes of its light, which is not the same before and after.
TEST(BodyTrails, AreAsBrightAtTheEndsOfASegment) {
  const auto at = [](int passed, int frame) {
    const Show show = show_with(pi, 0.01, 0.5, 0.1, passed);
    const FrameState state = frame_state(show, frame);
    return light(images(show, state, body_times(show, state, 0)));
  };
  using Both = std::pair<int, int>;
  for (const auto& [passed, frame] :
       {Both(0, 0), Both(1, 0), Both(2, 0), Both(2, 1), Both(4, 0), Both(99, 99)})
    EXPECT_NEAR(at(passed, frame) / at(50, 50 + frame - passed), 1, 0.15) << passed << " " << frame;
}

// A body at 0.41 c shines forward, and the halves of its ring, which are of two orders, meet without
// a step: a quarter turn from the way of the body, where the ring is faintest but for that.
TEST(BodyTrails, AreRingsWithoutASeam) {
  const Show show = show_with(pi, 0, 0.5, 0.1);
  const FrameState state = frame_state(show, 50);
  const std::vector<StarImage> ring = images(show, state, body_times(show, state, 0));
  constexpr std::size_t kSectors = 24;
  std::array<double, kSectors> light{};
  for (const StarImage& image : ring) {
    const double turn = std::atan2(image.y - 200, image.x - 200) / (2 * pi) + 1;
    light[static_cast<std::size_t>(turn * kSectors) % kSectors] += image.rgb[1];
  }
  // The way of the body is along x, so that the seams are at a quarter and at three quarters.
  for (const std::size_t seam : {kSectors / 4, 3 * kSectors / 4}) {
    const auto step = [&](std::size_t k) { return std::log(light[k] / light[k - 1]); };
    EXPECT_NEAR(step(seam), (step(seam - 1) + step(seam + 1)) / 2, 0.1) << seam;
  }
}

// A guess of when the light left saves time and changes nothing, however wrong it is.
TEST(BodyTrails, AskForImagesNearThoseThatTheyHave) {
  const Show show = show_with(2, 0, 2, 0.05);
  const FrameState state = frame_state(show, 50);
  const BodySight sight(state, show.effects, show.least_star_radius);
  const auto image = sight.image(show.bodies[0], 1);
  ASSERT_TRUE(image);
  for (const double off : {0.01, -3.0, 1000.0}) {
    const auto guessed = sight.image(show.bodies[0], 1, image->traced.proper_time + off);
    ASSERT_TRUE(guessed) << off;
    EXPECT_NEAR(guessed->traced.proper_time, image->traced.proper_time, 1e-8) << off;
    EXPECT_LT((guessed->at.direction.v - image->at.direction.v).length(), 1e-8) << off;
  }
}

// The instant of frame 50 is the same however fast the clock runs, and the trail is not.
TEST(BodyTrails, HaveTheirSpeedInTheKeyOfTheFrame) {
  const auto key = [](double m_per_frame) {
    Show show = show_with(pi, 0, 2, 0.05);
    show.timeline[0].timing = {100 - 50 * m_per_frame, 100 + 50 * m_per_frame};
    FrameState state = frame_state(show, 50);
    state.observer = frame_state(show_with(pi, 0, 2, 0.05), 50).observer;
    return FrameKeys(show, "").scene(state);
  };
  EXPECT_NE(key(2), key(1));
  EXPECT_EQ(key(2), key(2));
}

// Each body's matte is of its own trail, and the layer of bodies is what the picture has of them.
TEST(BodyTrails, AreInLayersAndMattes) {
  Show show = show_with(pi, 0, 2, 0.1);
  show.output.layers = {Layer::kBodies};
  show.output.data.mattes = true;
  const auto rendered = [&](double shutter) {
    show.exposure.shutter = shutter;
    LayeredFloatFrame frame;
    for (const Layer layer : show.output.layers) frame.layers.push_back({layer});
    frame.mattes = mattes_of(show);
    Renderer(show, 1).render(frame_state(show, 50), frame);
    return frame;
  };
  for (const double shutter : {0.0, 0.5}) {
    const LayeredFloatFrame frame = rendered(shutter);
    std::size_t covered = 0;
    for (std::size_t k = 0; k < frame.mattes[0].covered.size(); ++k) {
      // Nothing else shines.
      ASSERT_EQ(frame.picture.pixels[3 * k + 1], frame.layers[0].light.pixels[3 * k + 1]);
      if (frame.picture.pixels[3 * k + 1] > 1e-3) {
        ASSERT_NEAR(frame.mattes[0].covered[k], 1, 1e-3);
        ++covered;
      }
    }
    EXPECT_GT(covered, 500u) << shutter;
  }
}

class SpinTrails : public ShowFile {};

// A star passes through the cusp of a caustic about a spin, where images come and go: all of them together
// are the mean over two frames.
TEST_F(SpinTrails, HaveTheLightOfTwoFrames) {
  if (kSanitized) GTEST_SKIP() << "takes minutes";
  const Show show = read(
      "frames_per_second: 12\nsize: [64, 64]\n"
      "camera: {projection: rectilinear, fov_deg: 40, look_at: hole}\n"
      "black_hole: {mass_solar: 4e6, spin: 0.9}\n"
      "sky: {region_I: {background: black, stars: none}}\n"
      "bodies: {star: {r: 12, magnitude: -4, azimuth_deg: 228}}\n"
      "timeline: [{duration_s: 3, trajectory: {type: static, r: 30, rate_m_per_s: 14}}]\n");
  const FrameState state = frame_state(show, 23);
  const std::vector<StarImage> trail = images(show, state, body_times(show, state, 0));
  constexpr int kHalf = 16;
  double mean = 0;
  for (int k = 1 - kHalf; k < kHalf; ++k) {
    const double u = static_cast<double>(k) / kHalf;
    FrameState then = state;
    then.observer = observer_after(show, state, u, CameraMotion::kStays);
    mean += (1 - std::abs(u)) / kHalf * light(images(show, then, {}));
  }
  EXPECT_GT(trail.size(), 100u);
  EXPECT_GT(mean, 2 * light(images(show, state, {})));
  // Both are sums over some tens of instants of light that has a peak.
  EXPECT_NEAR(light(trail) / mean, 1, 0.03);
}

}  // namespace
}  // namespace domefall
