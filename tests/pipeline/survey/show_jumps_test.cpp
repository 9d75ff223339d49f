#include "pipeline/survey/show_jumps.h"

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class ShowJumps : public ShowFile {
 protected:
  Show timeline(const std::string& segments, const std::string& more = "") {
    return read("black_hole: {mass_solar: 4e6}\n" + more + "timeline:\n" + segments);
  }
};

std::vector<std::string> texts(const Show& show) {
  std::vector<std::string> all;
  for (const ShowWarning& w : jump_warnings(show)) all.push_back(w.text);
  return all;
}

TEST_F(ShowJumps, JointsSayWhatJumps) {
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

TEST_F(ShowJumps, ACalmShowHasNoWarning) {
  EXPECT_TRUE(texts(timeline("  - {duration_s: 4, trajectory: {type: circular, r: 9, orbits: 3}}\n"
                             "  - {duration_s: 4, trajectory: {type: static, r: 12}}\n",
                             "keyframes:\n"
                             "  - {at_s: 0, exposure: {ev: -6}}\n"
                             "  - {at_s: 3, exposure: {ev: 1}}\n"))
                  .empty());
}

TEST_F(ShowJumps, AFastRollAndAFlashAreWarnedOfWhereTheyAre) {
  const auto warnings =
      jump_warnings(timeline("  - duration_s: 6\n"
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

TEST_F(ShowJumps, AClockThatChangesItsRateWhereTheMotionGoesOnIsWarnedOf) {
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

}  // namespace
}  // namespace domefall
