#include "pipeline/survey/show_survey.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/colour/colour_space.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/survey/light_survey.h"
#include "pipeline/survey/show_jumps.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class Surveys : public ShowFile {
 protected:
  Show timeline(const std::string& segments, const std::string& more = "") {
    return read("black_hole: {mass_solar: 4e6}\n" + more + "timeline:\n" + segments);
  }
};

TEST_F(Surveys, APeriastronBetweenFramesIsFound) {
  // 6 M is passed in the middle of a show of 3.4 s with 2 frames a second: between frames 3 and 4.
  const Show show = timeline(
      "  - {duration_s: 3.4, trajectory: {type: parabolic, periastron: 6, from_r: 40, to_r: 40, "
      "to_leg: outward}}\n",
      "frames_per_second: 2\n");
  const ShowSurvey s = survey(show);
  ASSERT_TRUE(s.closest);
  EXPECT_NEAR(s.closest->value, 6, 1e-12);
  EXPECT_NEAR(s.closest->time_s, 1.7, 1e-6);
  EXPECT_EQ(s.closest->frame, 3);
  EXPECT_EQ(s.segments[0].type, "parabolic");
  EXPECT_NEAR(s.segments[0].r_end, 40, 1e-9);
}

TEST_F(Surveys, APeriastronIsFoundAmongMoreTurnsThanFrames) {
  const ShowSurvey s = survey(timeline(
      "  - {duration_s: 2, trajectory: {type: bound, periastron: 7, apoastron: 900, rate_m_per_s: "
      "1e9}}\n"));
  EXPECT_NEAR(s.closest->value, 7, 1e-9);
}

TEST_F(Surveys, RegionsAreNamedInTheOrderVisited) {
  const ShowSurvey s = survey(timeline(
      "  - {duration_s: 2, trajectory: {type: kruskal, energy: 0.001, from_r: 0.1, to_r: 0.1, "
      "to_leg: inward}}\n"
      "  - {duration_s: 2, trajectory: {type: infall, region: III, from_r: 5, to_r: 1}}\n"));
  using enum Region;
  EXPECT_EQ(s.segments[0].regions, (std::vector{kIV, kI, kII}));
  EXPECT_EQ(s.segments[1].regions, (std::vector{kIII, kII}));
  EXPECT_EQ(s.regions, (std::vector{kIV, kI, kII, kIII, kII}));
}

TEST_F(Surveys, SpeedsAreThoseOfKeplersCircles) {
  // v^2 = 1/(r - 2) against the static observer: v = 1/2 at the last stable orbit, gamma v = 1/sqrt(3).
  const ShowSurvey s =
      survey(timeline("  - {duration_s: 1, trajectory: {type: circular, r: 6}}\n"));
  EXPECT_NEAR(s.fastest->value, 1 / std::sqrt(3), 1e-14);
  // To who is at rest there all light is bluer by one factor; ahead and behind are both sky.
  EXPECT_NEAR(s.bluest->value, std::sqrt(2.0 / 3) / std::sqrt(3), 1e-14);
  EXPECT_NEAR(s.reddest->value, std::sqrt(2.0 / 3) * std::sqrt(3), 1e-14);
}

TEST_F(Surveys, OfOneAtRestAllOfTheSkyIsBluerByOneFactor) {
  const ShowSurvey s = survey(timeline("  - {duration_s: 1, trajectory: {type: static, r: 8}}\n"));
  EXPECT_NEAR(s.bluest->value, std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(s.reddest->value, std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(s.fastest->value, 0, 1e-14);
}

TEST_F(Surveys, FlatSpaceHasShiftsAndNoPlace) {
  const ShowSurvey s =
      survey(read("timeline: [{duration_s: 1, trajectory: {type: velocity, speed: 0.6, direction: "
                  "Vega}}]\n"));
  EXPECT_FALSE(s.closest);
  EXPECT_NEAR(s.bluest->value, 0.5, 1e-14);
  EXPECT_NEAR(s.reddest->value, 2, 1e-14);
  EXPECT_NEAR(s.fastest->value, 0.75, 1e-14);
}

TEST_F(Surveys, ABlackSkyHasNoShift) {
  const ShowSurvey s = survey(timeline("  - {duration_s: 1, trajectory: {type: static, r: 8}}\n",
                                       "sky: {region_I: {background: black, stars: none}}\n"));
  EXPECT_FALSE(s.bluest);
  EXPECT_FALSE(s.reddest);
}

// Against the code that draws pictures: no look is beyond the range, and some come close to its ends.
struct Observed {
  const char* name;
  Region region;
  Tetrad tetrad;
  double r;
  V3d celerity;
};
TEST(FrequencyRange, IsThatOfManyLooks) {
  for (const Observed& c :
       {Observed{"rest", Region::kI, Tetrad::kRain, 5, resting_celerity(5)},
        Observed{"rain", Region::kI, Tetrad::kRain, 3, V3d(0, 0, 0)},
        Observed{"sideways", Region::kI, Tetrad::kRain, 3, V3d(0.2, -0.3, 0.9)},
        Observed{"outgoing", Region::kI, Tetrad::kOutgoing, 4, V3d(0.1, 0.2, 0.5)},
        Observed{"inside", Region::kII, Tetrad::kRain, 1.2, V3d(0.3, 0.1, 0.6)},
        Observed{"of three", Region::kIII, Tetrad::kRainOfThree, 6, V3d(-0.3, 0.5, 0)},
        Observed{"fast", Region::kI, Tetrad::kRain, 2.5, V3d(-3, 0, 4)}}) {
    FrameState state;
    state.observer.region = c.region, state.observer.tetrad = c.tetrad;
    state.observer.r = c.r, state.observer.celerity = c.celerity;
    const HoleOptics optics = make_hole_optics(c.r, c.tetrad, {true, true, false});
    const ViewTracer tracer(state, optics);
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    for (const bool far : {false, true}) {
      const auto range = frequency_range(state.observer, far, false);
      ASSERT_EQ(range.has_value(), !far || c.r < 2) << c.name;
      if (!range) continue;
      const bool third = far != is_mirrored(c.tetrad);
      double least = HUGE_VAL, largest = 0;
      for (int k = 0; k < 200'000; ++k) {
        const V3d n(normal(generator), normal(generator), normal(generator));
        const ViewRay look = tracer.trace(CameraDirection{n.normalized()});
        if (!look.known || look.sky != (third ? SkyRegion::kIII : SkyRegion::kI)) continue;
        least = std::min(least, look.frequency_ratio);
        largest = std::max(largest, look.frequency_ratio);
      }
      EXPECT_GE(least, range->least * (1 - 1e-9)) << c.name;
      EXPECT_LE(largest, range->largest * (1 + 1e-9)) << c.name;
      // 2e5 looks are a degree apart.
      EXPECT_LT(least, range->least * 1.05) << c.name;
      EXPECT_GT(largest, range->largest * 0.95) << c.name;
    }
  }
}

// It was 0, and 1 + z infinite.
TEST(FrequencyRange, BehindTheFastestObserverLightIsRedButThere) {
  ObserverState o;
  o.r = 8, o.celerity = {-1e9, 0, 0};
  const auto range = frequency_range(o, false, false);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least * 2e9 * 1.5, 1, 1e-12);  // gamma - gamma v over 1 + s
}

TEST(FrequencyRange, StraightLightHasNoSilhouette) {
  ObserverState o;
  o.r = 4, o.celerity = resting_celerity(4);
  const auto range = frequency_range(o, false, true);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(range->largest, std::sqrt(2.0), 1e-14);
}

// ---- jumps ----

std::vector<std::string> texts(const Show& show) {
  std::vector<std::string> all;
  for (const ShowWarning& w : show_warnings(show)) all.push_back(w.text);
  return all;
}

TEST_F(Surveys, JointsSayWhatJumps) {
  const auto joints = segment_joints(timeline(
      "  - {duration_s: 1, trajectory: {type: parabolic, periastron: 6, from_r: 20, to_r: 10}}\n"
      "  - {duration_s: 1, trajectory: {type: continue, to_r: 8}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 8}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 12}}\n"));
  ASSERT_EQ(joints.size(), 3);
  EXPECT_FALSE(joints[0].place_jumps());
  EXPECT_FALSE(joints[0].velocity_jumps());
  EXPECT_FALSE(joints[1].place_jumps());
  // A fall from rest at infinity moves at sqrt(2/r) against the static observer.
  EXPECT_NEAR(joints[1].speed.value(), 0.5, 1e-12);
  EXPECT_TRUE(joints[2].place_jumps());
  EXPECT_NEAR(joints[2].r_after, 12, 1e-12);
  EXPECT_FALSE(joints[2].speed);
}

TEST_F(Surveys, ACalmShowHasNoWarning) {
  EXPECT_TRUE(texts(timeline("  - {duration_s: 4, trajectory: {type: circular, r: 9, orbits: 3}}\n"
                             "  - {duration_s: 4, trajectory: {type: static, r: 12}}\n",
                             "keyframes:\n"
                             "  - {at_s: 0, exposure: {ev: -6}}\n"
                             "  - {at_s: 3, exposure: {ev: 1}}\n"))
                  .empty());
}

TEST_F(Surveys, AFastRollAndAFlashAreWarnedOfWhereTheyAre) {
  const auto warnings =
      show_warnings(timeline("  - duration_s: 6\n"
                             "    trajectory: {type: static, r: 12}\n"
                             "    keyframes:\n"
                             "      - {at_s: 1, camera: {roll_deg: 0}, exposure: {ev: 0}}\n"
                             "      - {at_s: 3, camera: {roll_deg: 90}, ease: linear}\n"
                             "      - {at_s: 4, exposure: {ev: 2}, ease: hold}\n"
                             "      - {at_s: 5, sky: {region_I: {gain: 3}}, ease: hold}\n"));
  ASSERT_EQ(warnings.size(), 3);
  EXPECT_EQ(warnings[0].text, "the camera turns by 45 degrees a second");
  EXPECT_GE(warnings[0].time_s, 1);
  EXPECT_LE(warnings[0].time_s, 3);
  EXPECT_EQ(warnings[1].text, "the exposure changes by +2 stops between frames");
  EXPECT_EQ(warnings[1].frame, 120);
  EXPECT_EQ(warnings[2].text, "sky.region_I.gain jumps at a keyframe that holds");
  EXPECT_EQ(warnings[2].frame, 150);
}

TEST_F(Surveys, AClockThatChangesItsRateWhereTheMotionGoesOnIsWarnedOf) {
  const std::string first =
      "  - {duration_s: 2, trajectory: {type: circular, r: 9, rate_m_per_s: 10}}\n";
  const auto after = [&](const std::string& rate) {
    return texts(timeline(
        first + "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: " + rate + "}}\n"));
  };
  EXPECT_TRUE(after("19").empty());
  EXPECT_EQ(after("25"), std::vector<std::string>{
                             "the motion goes on, but its clock jumps from 10 to 25 M a second"});
  EXPECT_EQ(after("[4, 10]").size(), 1);
  EXPECT_TRUE(after("[10, 1]").empty());
}

// ---- light ----

TEST(LightSurvey, FindsTheBrightestPictureAndKeepsItsMean) {
  Show show = starry(show_of(StaticObserver{12}, Domemaster{256}));
  show.mass_solar = 1e6;
  show.timeline[0].duration_s = 6;
  show.timeline[0].timing.tau_end = 1;
  // Brightest in the middle; the ends are fades.
  show.timeline[0].curves[static_cast<std::size_t>(Channel::kEv)] =
      Curve{{{0, -9}, {2, 0}, {3, 1}, {4, 0.5}, {6, -8}}};
  Renderer renderer(show, 2);
  const LightSurvey found = survey_light(show, renderer, nullptr);
  EXPECT_EQ(found.frames, 7);
  EXPECT_NEAR(found.brightest.time_s, 3, 0.1);
  EXPECT_LT(found.darkest.mean, found.brightest.mean);
  EXPECT_GE(found.darkest.ev, found.brightest.ev - 3);
  EXPECT_GT(found.brightest.percentile99, found.brightest.mean);
  // The same mean as a picture of 256 pixels.
  const HalfFrame large = renderer.render(frame_state(show, found.brightest.frame));
  double sum = 0;
  int count = 0;
  for (int row = 0; row < 256; ++row) {
    const ColumnRange range = inside_columns(show.projection, row);
    for (int k = range.first; k <= range.last; ++k, ++count) {
      const Imath::half* rgb = large.row(row) + 3 * k;
      sum += luminance({rgb[0], rgb[1], rgb[2]});
    }
  }
  EXPECT_NEAR(found.brightest.mean / (sum / count), 1, 0.1);
}

}  // namespace
}  // namespace domefall
