#include "pipeline/program/survey/body_motion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A body circles at 8 M over an observer at 30 M and behind the hole, once in 142 M.
class BodyMotions : public ShowFile {
 protected:
  std::vector<std::string> warned(double m_per_s, const std::string& more = "") {
    const Show show = read(fmt::format(
        "frames_per_second: 30\nsize: 512\nblack_hole: {{mass_solar: 4e6}}\n"
        "sky: {{region_I: {{background: black, stars: none}}}}\n"
        "camera: {{look_at: hole, elevation_deg: 90}}\n{}"
        "bodies: {{racer: {{r: 8, inclination_deg: 90, azimuth_deg: 90, magnitude: -2}}}}\n"
        "timeline:\n  - {{duration_s: 0.5, trajectory: {{type: static, r: 30, rate_m_per_s: "
        "{}}}}}\n",
        more, m_per_s));
    std::vector<std::string> texts;
    for (const ShowWarning& warning : body_warnings(show)) texts.push_back(warning.text);
    return texts;
  }
};

TEST_F(BodyMotions, AreNotWarnedOfWhereTheyCanBeFollowed) {
  EXPECT_THAT(warned(60), IsEmpty());
  EXPECT_THAT(warned(0.001), IsEmpty());
}

TEST_F(BodyMotions, ThatJumpAndFlashAreWarnedOf) {
  EXPECT_THAT(warned(600), ElementsAre(HasSubstr("bodies.racer moves by "),
                                       HasSubstr("bodies.racer passes straight behind")));
}

// A streak is as long as the shutter is open, and one from frame to frame leaves no gap.
TEST_F(BodyMotions, ThatAreStreaksDoNotJump) {
  for (const std::string& text : warned(600, "exposure: {shutter_deg: 360}\n"))
    EXPECT_THAT(text, Not(HasSubstr("moves by")));
}

}  // namespace
}  // namespace domefall
