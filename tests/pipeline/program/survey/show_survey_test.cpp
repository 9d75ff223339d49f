#include "pipeline/program/survey/show_survey.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipeline/program/survey/show_jumps.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Surveys = ObservedShow;

TEST_F(Surveys, APeriastronBetweenFramesIsFound) {
  // 6 M is passed in the middle of a show of 3.4 s with 2 frames a second, between frames 3 and 4.
  const ShowSurvey s = survey(show(
      "  - {duration_s: 3.4, trajectory: {type: parabolic, periastron: 6, from_r: 40, to_r: 40, "
      "to_leg: outward}}\n",
      "frames_per_second: 2\n"));
  ASSERT_TRUE(s.closest);
  EXPECT_NEAR(s.closest->value, 6, 1e-12);
  EXPECT_NEAR(s.closest->time_s, 1.7, 1e-6);
  EXPECT_EQ(s.closest->frame, 3);
  EXPECT_EQ(s.segments[0].type, "parabolic");
  EXPECT_NEAR(s.segments[0].r_end, 40, 1e-9);
}

TEST_F(Surveys, APeriastronIsFoundAmongMoreTurnsThanFrames) {
  const ShowSurvey s = survey(show(
      "  - {duration_s: 2, trajectory: {type: bound, periastron: 7, apoastron: 900, rate_m_per_s: "
      "1e9}}\n"));
  EXPECT_NEAR(s.closest->value, 7, 1e-9);
}

TEST_F(Surveys, APeriastronIsFoundWithinAWayOfMillionsOfYears) {
  // The orbit turns at 10 M, in 1e-11 of the segment's proper time.
  const ShowSurvey s = survey(
      show("  - {duration_s: 2, trajectory: {type: thrown, from_r: 1e9, speed: 4.5e-5, direction: "
           "{radial: -1, phi: 1.11111111e-4}, to_r: 3e8, to_leg: outward}}\n"));
  EXPECT_NEAR(s.closest->value, 10, 0.01);
}

// It was told as "0 M of proper time".
TEST_F(Surveys, TheProperTimeOfADeepSegmentIsWhatPasses) {
  const ShowSurvey s = survey(
      show("  - {duration_s: 10, trajectory: {type: kruskal, energy: 0.99999999, from_r: 0.001, "
           "rate_m_per_s: 0.0000001}}\n"));
  EXPECT_NEAR(s.segments[0].proper_time, 1e-6, 1e-20);
  EXPECT_NEAR(s.segments[0].rate_begin, 1e-7, 1e-13);
  EXPECT_NEAR(s.segments[0].rate_end, 1e-7, 1e-13);
  EXPECT_NEAR(s.segments[0].r_begin, 0.001, 1e-15);
}

// At 24 frames a second and the last stable orbit, 0.068 radians a M.
TEST_F(Surveys, APatternThatTurnsTooFastIsWarnedOf) {
  const auto warned = [this](const char* pattern, double rate) {
    const Show s = show(fmt::format("  - {{duration_s: 1, trajectory: {{type: static, r: 30, "
                                    "rate_m_per_s: {}}}}}\n",
                                    rate),
                        fmt::format("frames_per_second: 24\ndisc: {{pattern: {}}}\n", pattern));
    const auto warnings = jump_warnings(s);
    return !warnings.empty() && warnings[0].text.find("the disc's inner gas turns") == 0;
  };
  const double limit =
      20 * std::numbers::pi / 180 * std::pow(6, 1.5) * 24 * std::sqrt(1 - 2.0 / 30);
  EXPECT_TRUE(warned("turbulence", 1.01 * limit));
  EXPECT_FALSE(warned("turbulence", 0.99 * limit));
  EXPECT_TRUE(warned("spot", 1.01 * limit));
  EXPECT_FALSE(warned("rings", 2 * limit));
  EXPECT_FALSE(warned("none", 2 * limit));
}

TEST_F(Surveys, RegionsAreNamedInTheOrderVisited) {
  const ShowSurvey s = survey(
      show("  - {duration_s: 2, trajectory: {type: kruskal, energy: 0.001, from_r: 0.1, to_r: 0.1, "
           "to_leg: inward}}\n"
           "  - {duration_s: 2, trajectory: {type: infall, region: III, from_r: 5, to_r: 1}}\n"));
  using enum Region;
  EXPECT_EQ(s.segments[0].visits, (std::vector<Visit>{{kIV}, {kI}, {kII}}));
  EXPECT_EQ(s.segments[1].visits, (std::vector<Visit>{{kIII}, {kII}}));
  EXPECT_EQ(s.visits, (std::vector<Visit>{{kIV}, {kI}, {kII}, {kIII}, {kII}}));
}

// The inside of the hole is passed in 1e-5 of the segment's time.
TEST_F(Surveys, RegionsOfEveryUniverseAreNamed) {
  const ShowSurvey s = survey(
      read("frames_per_second: 1\nblack_hole: {mass_solar: 4e6, charge: 0.5}\ntimeline:\n"
           "  - {duration_s: 3, trajectory: {type: infall, rest_r: 1e4, rate_m_per_s: 1.6e6}}\n"
           "  - {duration_s: 3, trajectory: {type: static, r: 9}}\n"));
  using enum Region;
  EXPECT_EQ(s.segments[0].visits,
            (std::vector<Visit>{
                {kI}, {kII}, {kV}, {kIV, 1}, {kI, 1}, {kII, 1}, {kV, 1}, {kIV, 2}, {kI, 2}}));
  EXPECT_EQ(s.segments[1].visits, (std::vector<Visit>{{kI, 2}}));
  for (const SkyRegion sky : kExteriorSkies) EXPECT_TRUE(s.skies[sky]);
  EXPECT_EQ(region_name(s.visits.back().region, s.visits.back().universe), "I+2");
}

TEST_F(Surveys, SpeedsAreThoseOfKeplersCircles) {
  // Against the static observer v^2 = 1/(r - 2), so that v = 1/2 at the last stable orbit and gamma
  // v is 1/sqrt(3).
  const ShowSurvey s = survey(show("  - {duration_s: 1, trajectory: {type: circular, r: 6}}\n"));
  EXPECT_NEAR(s.fastest->value, 1 / std::sqrt(3), 1e-14);
  // At rest there all light is bluer by one factor, and the sky is both ahead and behind.
  EXPECT_NEAR(s.bluest->value, std::sqrt(2.0 / 3) / std::sqrt(3), 1e-14);
  EXPECT_NEAR(s.reddest->value, std::sqrt(2.0 / 3) * std::sqrt(3), 1e-14);
}

TEST_F(Surveys, OfOneAtRestAllOfTheSkyIsBluerByOneFactor) {
  const ShowSurvey s = survey(show("  - {duration_s: 1, trajectory: {type: static, r: 8}}\n"));
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
  const ShowSurvey s = survey(show("  - {duration_s: 1, trajectory: {type: static, r: 8}}\n",
                                   "sky: {region_I: {background: black, stars: none}}\n"));
  EXPECT_FALSE(s.bluest);
  EXPECT_FALSE(s.reddest);
}

using ShowJumps = ObservedShow;

std::vector<std::string> texts(const Show& show) {
  std::vector<std::string> all;
  for (const ShowWarning& w : jump_warnings(show)) all.push_back(w.text);
  return all;
}

TEST_F(ShowJumps, JointsSayWhatJumps) {
  const auto joints = segment_joints(show(
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

TEST_F(ShowJumps, ACalmShowHasNoWarning) {
  EXPECT_TRUE(texts(show("  - {duration_s: 4, trajectory: {type: circular, r: 9, orbits: 3}}\n"
                         "  - {duration_s: 4, trajectory: {type: static, r: 12}}\n",
                         "keyframes:\n"
                         "  - {at_s: 0, exposure: {ev: -6}}\n"
                         "  - {at_s: 3, exposure: {ev: 1}}\n"))
                  .empty());
}

TEST_F(ShowJumps, AFastRollAndAFlashAreWarnedOfWhereTheyAre) {
  const auto warnings =
      jump_warnings(show("  - duration_s: 6\n"
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

// A body is nowhere before its first light is there.  A hole of 203,000 suns has 1 M of a second.
TEST_F(ShowJumps, ATurnToABodyThatIsFirstSeenIsWarnedOf) {
  const auto found = [&](const std::string& begins) {
    return jump_warnings(
        read("black_hole: {mass_solar: 2.03e5}\n"
             "bodies: {late: {trajectory: {type: infall, rest_r: 8}, azimuth_deg: 25, begins_m: " +
             begins +
             "}}\n"
             "camera: {look_at: {body: late}, elevation_deg: 60}\n"
             "keyframes:\n"
             "  - {at_s: 5, camera: {look_at: {body: late}}}\n"
             "  - {at_s: 15.9, camera: {look_at: hole}}\n"
             "timeline: [{duration_s: 16, trajectory: {type: static, r: 8}}]\n"));
  };
  EXPECT_TRUE(found("-12").empty());
  const auto late = found("-3");
  ASSERT_EQ(late.size(), 1);
  EXPECT_EQ(late[0].frame, 27);
  EXPECT_TRUE(late[0].text.starts_with("the camera turns by ")) << late[0].text;
}

TEST_F(ShowJumps, AClockThatChangesItsRateWhereTheMotionGoesOnIsWarnedOf) {
  const std::string first =
      "  - {duration_s: 2, trajectory: {type: circular, r: 9, rate_m_per_s: 10}}\n";
  const auto after = [&](const std::string& rate) {
    return texts(show(
        first + "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: " + rate + "}}\n"));
  };
  EXPECT_TRUE(after("19").empty());
  EXPECT_EQ(after("25"), std::vector<std::string>{
                             "the motion goes on, but its clock jumps from 10 to 25 M a second"});
  EXPECT_EQ(after("[4, 10]").size(), 1);
  EXPECT_TRUE(after("[10, 1]").empty());
}

}  // namespace
}  // namespace domefall
