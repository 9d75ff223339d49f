#include "pipeline/survey/show_survey.h"

#include <cmath>

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
  // 6 M is passed in the middle of a show of 3.4 s with 2 frames a second, between frames 3 and 4.
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

TEST_F(Surveys, APeriastronIsFoundWithinAWayOfMillionsOfYears) {
  // The orbit turns at 10 M, in 1e-11 of the segment's proper time.
  const ShowSurvey s = survey(timeline(
      "  - {duration_s: 2, trajectory: {type: thrown, from_r: 1e9, speed: 4.5e-5, direction: "
      "{radial: -1, phi: 1.11111111e-4}, to_r: 3e8, to_leg: outward}}\n"));
  EXPECT_NEAR(s.closest->value, 10, 0.01);
}

// It was told as "0 M of proper time".
TEST_F(Surveys, TheProperTimeOfADeepSegmentIsWhatPasses) {
  const ShowSurvey s = survey(timeline(
      "  - {duration_s: 10, trajectory: {type: kruskal, energy: 0.99999999, from_r: 0.001, "
      "rate_m_per_s: 0.0000001}}\n"));
  EXPECT_NEAR(s.segments[0].proper_time, 1e-6, 1e-20);
  EXPECT_NEAR(s.segments[0].rate_begin, 1e-7, 1e-13);
  EXPECT_NEAR(s.segments[0].rate_end, 1e-7, 1e-13);
  EXPECT_NEAR(s.segments[0].r_begin, 0.001, 1e-15);
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
  // Against the static observer v^2 = 1/(r - 2), so that v = 1/2 at the last stable orbit and gamma
  // v is 1/sqrt(3).
  const ShowSurvey s =
      survey(timeline("  - {duration_s: 1, trajectory: {type: circular, r: 6}}\n"));
  EXPECT_NEAR(s.fastest->value, 1 / std::sqrt(3), 1e-14);
  // At rest there all light is bluer by one factor, and the sky is both ahead and behind.
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

}  // namespace
}  // namespace domefall
