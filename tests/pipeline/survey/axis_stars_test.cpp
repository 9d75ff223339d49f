#include "pipeline/survey/axis_stars.h"

#include <gmock/gmock.h>

#include "pipeline/survey/show_survey.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using testing::HasSubstr;

// The catalogue has Sirius and two stars besides.
class AxisStarWarnings : public ShowFile {
 protected:
  std::vector<ShowWarning> of(const std::string& at, const std::string& trajectory,
                              const std::string& more = "") {
    const Show show = read(
        "frames_per_second: 10\nblack_hole: {mass_solar: 4e6, at: " + at +
        ", heading_deg: 20}\nsky: {region_I: {background: black, stars: {gain: 1}}, region_III: "
        "{background: "
        "black}}\n" +
        more + "camera: {look_at: hole}\ntimeline:\n  - {duration_s: 3, trajectory: " + trajectory +
        "}\n");
    AxisStars axis(show);
    survey(show, [&axis](const FrameState& state) { axis.add(state); });
    return axis.warnings();
  }
};

TEST_F(AxisStarWarnings, AStarBehindAnObserverAtRestIsToldWithWhatDimsIt) {
  const auto warnings = of("Sirius", "{type: static, r: 14}");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].frame, 0);
  EXPECT_THAT(warnings[0].text, HasSubstr("Sirius stands straight behind the hole, and its ring "
                                          "blinds like a star of magnitude -11."));
  EXPECT_THAT(warnings[0].text, HasSubstr("stars.least_radius_deg: 0.5 dims it"));
}

TEST_F(AxisStarWarnings, WhatIsAdvisedHelps) {
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "stars: {least_radius_deg: 0.5}\n").empty());
  EXPECT_FALSE(of("Sirius", "{type: static, r: 14}", "stars: {least_radius_deg: 0.2}\n").empty());
}

TEST_F(AxisStarWarnings, AMotionThatBeginsAtRestIsSeen) {
  const auto warnings = of("Sirius", "{type: circular, r: 14, orbits: 0.02, pace: eased}");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].frame, 0);
}

// The light of a frame's time is all that a star has which races past.
TEST_F(AxisStarWarnings, AStarThatRacesPastDoesNotBlind) {
  EXPECT_TRUE(of("Sirius", "{type: circular, r: 14, orbits: 2}").empty());
}

TEST_F(AxisStarWarnings, AStarBesideTheAxisDoesNotBlind) {
  EXPECT_TRUE(of("{ra_deg: 101.287, dec_deg: -14.7}", "{type: static, r: 14}").empty());
}

TEST_F(AxisStarWarnings, WhatTheShowLeavesInTheDarkDoesNotBlind) {
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "exposure: {ev: -8}\n").empty());
  EXPECT_TRUE(of("Sirius", "{type: static, r: 14}", "effects: {amplification: none}\n").empty());
}

}  // namespace
}  // namespace domefall
