#include "pipeline/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

bool equal_bytes(const HalfFrame& a, const HalfFrame& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]) == 0;
}

TEST(Renderer, AFrameIsTheSameBytesForAnyNumberOfThreadsAloneOrInARun) {
  Show show = starry(show_of(RadialInfall{2.5}, Domemaster{tries(200, 100)}));
  show.timeline[0].timing.tau_end = 1.6;
  Renderer run(show, 1);
  for (const int frame : {3, 14, 15, 29}) {
    const HalfFrame in_run = run.render(frame_state(show, frame));
    for (const int threads : {1, 2, 5}) {
      EXPECT_TRUE(equal_bytes(in_run, Renderer(show, threads).render(frame_state(show, frame))))
          << "frame " << frame << ", " << threads << " threads";
    }
  }
}

// An open shutter and a dissolve round halves once more, at the end.
TEST(Renderer, AFrameOfFloatsIsTheOneOfHalvesBeforeItIsRounded) {
  Show show = starry(show_of(RadialInfall{2.5}, Domemaster{100}));
  show.timeline[0].timing.tau_end = 1.6;
  show.exposure.ev = 12;  // beyond what a half holds
  FloatImage full;
  for (const double shutter : {0.0, 0.5}) {
    show.exposure.shutter = shutter;
    Renderer renderer(show, 2);
    const FrameState state = frame_state(show, 14);
    renderer.render(state, full);
    EXPECT_GT(*std::max_element(full.pixels.begin(), full.pixels.end()), 1e5f);
    const HalfFrame halves = renderer.render(state), rounded = half_frame(full);
    if (shutter == 0) {
      EXPECT_TRUE(equal_bytes(halves, rounded));
      continue;
    }
    ASSERT_EQ(halves.pixels.size(), rounded.pixels.size());
    for (std::size_t k = 0; k < halves.pixels.size(); ++k) {
      if (full.pixels[k] >= 65504) continue;
      const float value = halves.pixels[k];
      ASSERT_NEAR(value, static_cast<float>(rounded.pixels[k]), 2e-3f * value + 1e-6f) << k;
    }
  }
}

TEST(Renderer, BuildsNoTableInFlatSpaceAndNoneForBlackSkies) {
  const Show flat = starry(show_of(StaticObserver{}, Domemaster{32}));
  const FramePlan plan = plan_frame(flat, frame_state(flat, 0));
  EXPECT_FALSE(plan.gravity);
  StageTimes times;
  Renderer(flat, 1).render(frame_state(flat, 0), &times);
  EXPECT_EQ(times.table_nodes, 0u);

  const Show black = show_of(StaticObserver{10}, Domemaster{32});
  Renderer(black, 1).render(frame_state(black, 0), &times);
  EXPECT_EQ(times.table_nodes, 0u);
  EXPECT_EQ(times.images, 0u);

  const Show outside = starry(show_of(StaticObserver{10}, Domemaster{32}));
  EXPECT_FALSE(plan_frame(outside, frame_state(outside, 0))[SkyRegion::kIII].lit())
      << "region III is not seen from outside";
}

// The disc is that of the first universe.
TEST(Renderer, LeavesTheDiscBehindInTheNextUniverse) {
  const ChargedHole hole(1, 0.9L);
  Show show = show_of(ChargedOrbit::falling(hole, 9, 0, 0), Domemaster{32});
  show.spacetime = hole;
  show.disc = Disc{};
  show.disc->orbits = GasOrbits(hole);
  show.timeline[0].timing = {0, 24};
  EXPECT_TRUE(plan_frame(show, frame_state(show, 0)).disc);
  const FrameState beyond = frame_state(show, 29);
  EXPECT_EQ(beyond.observer.universe, 1);
  EXPECT_EQ(beyond.observer.region, Region::kI);
  EXPECT_FALSE(plan_frame(show, beyond).disc);
  EXPECT_NO_THROW(Renderer(show, 1).render(beyond));
}

TEST(Renderer, MakesOneTableForACameraThatStandsStill) {
  Show show = starry(show_of(StaticObserver{10}, Domemaster{64}));
  Renderer renderer(show, 1);
  StageTimes times;
  renderer.render(frame_state(show, 0), &times);
  EXPECT_EQ(times.tables_made, 1);
  renderer.render(frame_state(show, 20), &times);
  EXPECT_EQ(times.tables_made, 0);
  EXPECT_GT(times.table_nodes, 0u);
  // Inside both skies are seen.  Region IV is dark and has no table.
  const Show inside = starry(show_of(RadialInfall{1}, Domemaster{64}));
  Renderer(inside, 1).render(frame_state(inside, 0), &times);
  EXPECT_EQ(times.tables_made, 2);
}

TEST(Renderer, ReadsNoFileThatAFrameDoesNotShow) {
  Show show = starry(show_of(StaticObserver{10}, Domemaster{64}));
  show.sky[SkyRegion::kI].stars = StarField{"no/such/catalogue.csv", 6.5};
  show.sky[SkyRegion::kIII].background = PanoramaSky{"no/such/panorama.exr"};
  show.sky[SkyRegion::kIII].stars = StarField{"nor/this.csv", 6.5};
  EXPECT_THROW(Renderer(show, 1).render(frame_state(show, 0)), TemporaryError);
  show.sky[SkyRegion::kI].star_gain = 0;
  StageTimes times;
  EXPECT_NO_THROW(Renderer(show, 1).render(frame_state(show, 0), &times));
  EXPECT_EQ(times.images, 0u);
  show.sky[SkyRegion::kI].background_gain = 0;
  show.sky[SkyRegion::kI].background = PanoramaSky{"no/such/panorama.exr"};
  EXPECT_NO_THROW(Renderer(show, 1).render(frame_state(show, 0), &times));
  EXPECT_EQ(times.tables_made, 0);
}

TEST(Renderer, TracesNoRayWhereAllIsDark) {
  // An observer in region IV sees the past singularity in every direction, which is black here.
  Show show = starry(
      show_of(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.0, {0, 0, 0}}, Domemaster{128}));
  show.sky[SkyRegion::kI].stars = show.sky[SkyRegion::kIII].stars =
      StarField{"no/such/catalogue.csv", 6.5};
  StageTimes times;
  const HalfFrame frame = Renderer(show, 1).render(frame_state(show, 0), &times);
  EXPECT_EQ(times.tables_made, 0);
  EXPECT_EQ(times.images, 0u);
  for (const Imath::half value : frame.pixels) ASSERT_EQ(value, 0);
  // Outside, a silhouette costs little: few of the sky's pixels need a view ray of their own.
  const Show outside = starry(show_of(StaticObserver{4}, Domemaster{2048}));
  Renderer(outside, 2).render(frame_state(outside, 0), &times);
  EXPECT_LT(times.traced_fraction, 0.25);
}

TEST(Renderer, DrawsNothingOutsideTheDomeAndNothingInTheSilhouette) {
  const Show show = starry(show_of(StaticObserver{4}, Domemaster{256}));
  const FrameState state = frame_state(show, 0);
  const HalfFrame frame = Renderer(show, 2).render(state);
  const ViewTracer tracer(state, WantedSkies{});
  int dark = 0, outside = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const PixelPosition pixel{x + 1.0, y + 1.0};
      const float light = frame.row(y)[3 * x] + frame.row(y)[3 * x + 1] + frame.row(y)[3 * x + 2];
      const ViewRay ray = tracer.trace(direction_at(show.projection, pixel));
      if (!is_inside(show.projection, pixel)) {
        ++outside;
        EXPECT_EQ(light, 0);
      } else if (ray.sky == SkyRegion::kIV && ray.to_edge > 0.1) {
        ++dark;
        // Blobs of stars beside the edge do not reach so far.
        EXPECT_EQ(light, 0) << x << " " << y;
      } else if (ray.sky == SkyRegion::kI) {
        EXPECT_GT(light, 0) << "a black speck at " << x << " " << y;
      }
    }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(outside, 10000);
}

// render() throws if a pixel is not finite.  The observers are extreme ones.
TEST(Renderer, HasNoPixelThatIsNotFinite) {
  for (const Trajectory& trajectory :
       {Trajectory(StaticObserver{2.0000001}), Trajectory(StaticObserver{1e8}),
        Trajectory(CircularOrbit{3.0000001}), Trajectory(RadialInfall{1e-6}),
        Trajectory(RadialInfall{2.0}), Trajectory(RadialInfall{1.9999999}),
        Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, 30, {-1e9, 0, 0}}),
        Trajectory(GivenVelocity{Region::kII, Tetrad::kRain, 0.3, {0, 1e6, 0}}),
        Trajectory(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1e-6, {0, 0, 0}}),
        Trajectory(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.998, {0, 1e6, 0}}),
        Trajectory(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 2, {0, 0, 0}}),
        Trajectory(GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 2.001, {0, 0, 0}}),
        Trajectory(GivenVelocity{Region::kI, Tetrad::kOutgoing, 2.0000001, {-1e6, 0, 0}}),
        Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1e9, 0}})}) {
    for (const bool grid : {false, true}) {
      Show show = starry(show_of(trajectory, Domemaster{tries(48, 24)}));
      if (grid)
        show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background =
            show.sky[SkyRegion::kIV].background = GridSky{};
      EXPECT_NO_THROW(Renderer(show, 2).render(frame_state(show, 0))) << trajectory.index();
      show.sky[SkyRegion::kIV].background = RingsSky{1e-3};
      EXPECT_NO_THROW(Renderer(show, 2).render(frame_state(show, 0))) << trajectory.index();
    }
  }
}

// Every sample of the panorama or the grid is averaged over its footprint, so that a pixel of a
// frame of half the size is the mean of four pixels of the larger one.
TEST(Renderer, AFrameOfHalfTheSizeIsTheLargeOneMadeSmaller) {
  Show show = show_of(StaticObserver{20}, Domemaster{512});
  show.sky[SkyRegion::kI].background = GridSky{};
  const HalfFrame large = Renderer(show, 2).render(frame_state(show, 0));
  show.projection = Domemaster{256};
  const HalfFrame small = Renderer(show, 2).render(frame_state(show, 0));
  double difference = 0, sum = 0;
  for (int y = 20; y < 236; ++y)
    for (int x = 20; x < 236; ++x) {
      const float mean = (large.row(2 * y)[6 * x] + large.row(2 * y)[6 * x + 3] +
                          large.row(2 * y + 1)[6 * x] + large.row(2 * y + 1)[6 * x + 3]) /
                         4;
      difference += std::abs(mean - small.row(y)[3 * x]);
      sum += mean;
    }
  EXPECT_LT(difference / sum, 0.05);
}

// To an observer at rest at 20 M every ring is a circle about the hole's centre, across which the
// light falls and rises.  Of rings too narrow for the pixels the mean is left.
TEST(Renderer, DrawsTheSingularitysTimeAsRingsAboutTheAxis) {
  Show show = show_of(StaticObserver{20}, Stereographic{257, 257, 40 * kDegree});
  show.sky[SkyRegion::kIV].background = RingsSky{4};
  const auto green = [&show](int number) {
    const HalfFrame frame = Renderer(show, 2).render(frame_state(show, number));
    return [frame](int x, int y) { return static_cast<float>(frame.row(y)[3 * x + 1]); };
  };
  const auto still = green(0);
  // With 40 degrees on 257 pixels the silhouette's radius of 14 degrees is 87 pixels.
  float least = HUGE_VALF, most = 0;
  for (int k = 0; k < 80; ++k) {
    const float right = still(128 + k, 128);
    EXPECT_NEAR(still(128 - k, 128), right, 2e-3 * right) << k;
    EXPECT_NEAR(still(128, 128 + k), right, 2e-3 * right) << k;
    EXPECT_NEAR(still(128, 128 - k), right, 2e-3 * right) << k;
    least = std::min(least, right);
    most = std::max(most, right);
  }
  EXPECT_GT(most, 3.5f * least);
  EXPECT_LT(most, 4.05f * least);
  // The point (48, 36) is as far from the centre as (60, 0).
  EXPECT_NEAR(still(128 + 48, 128 + 36), still(128 + 60, 128), 2e-2f * most);

  // Half a period later, bright and dark have changed places at the centre.
  show.frames_per_second = 1;
  show.timeline[0].duration_s = 2;
  show.timeline[0].timing.tau_end = 2 * 2 * std::sqrt(0.9);
  EXPECT_NEAR(green(1)(128, 128) + still(128, 128), most + least, 5e-3f * most);

  show.sky[SkyRegion::kIV].background = RingsSky{0.001};
  EXPECT_NEAR(green(0)(128 + 60, 128), (most + least) / 2, 1e-2f * most);
}

TEST(Renderer, TabulatesEmissionTimesForRingsOnly) {
  Show show = show_of(StaticObserver{20}, Domemaster{32});
  StageTimes grid, rings;
  show.sky[SkyRegion::kIV].background = GridSky{};
  Renderer(show, 1).render(frame_state(show, 0), &grid);
  show.sky[SkyRegion::kIV].background = RingsSky{};
  Renderer(show, 1).render(frame_state(show, 0), &rings);
  EXPECT_GT(rings.table_nodes, grid.table_nodes);
  const HoleOptics optics = make_hole_optics(20, Tetrad::kRain, {true, false, true});
  EXPECT_FALSE(optics.emission_times);
}

}  // namespace
}  // namespace domefall
