#include "pipeline/program/survey/sky_survey.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/sources/sky/sky_file.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Skies of one texel, and a catalogue of a star for each half magnitude from 1 to 12.
class SkySurveys : public ShowFile {
 protected:
  SkySurveys() {
    write_map("to_6.sky", 6);
    write_map("to_11.sky", 11);
    std::ofstream stars(folder_ / "stars.csv");
    stars << "ra_deg,dec_deg,v_mag,b_v\n";
    for (int k = 2; k <= 24; ++k) stars << 10 * k << ",0," << k / 2.0 << ",0.5\n";
  }

  std::vector<SkySources> of(const std::string& sky, const std::string& timeline) {
    show_ = read("frames_per_second: 1\nblack_hole: {mass_solar: 4e6}\nsky:\n" + sky +
                 "timeline:\n" + timeline);
    return survey_skies(show_, survey(show_));
  }

 private:
  void write_map(const std::string& name, double fainter_than) {
    NewSkyFile file(folder_ / name, SkyMapKind::kColour, 1, 1, {"", {}, fainter_than});
    file.finish();
  }

  Show show_;
};

constexpr const char* kToSix =
    "  region_I: {background: to_6.sky, stars: {catalogue: stars.csv, max_magnitude: 6}}\n"
    "  region_III: {background: black, stars: none}\n";

TEST_F(SkySurveys, NoStarIsSeenTwiceToTheMapsOwnLimit) {
  const auto skies = of(kToSix, "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n");
  ASSERT_EQ(skies.size(), 1U);
  EXPECT_EQ(skies[0].stars, 11U);
  EXPECT_EQ(skies[0].twice, 0);
  EXPECT_EQ(segments_text(skies[0]), "");
}

// Only the limit with which the show begins was looked at.
TEST_F(SkySurveys, AKeyframeThatDeepensTheLimitIsSeen) {
  const auto skies = of(kToSix,
                        "  - duration_s: 9\n    trajectory: {type: static, r: 9}\n    keyframes:\n"
                        "      - {at_s: 3, sky: {region_I: {stars: {max_magnitude: 8}}}}\n"
                        "      - {at_s: 6, sky: {region_I: {stars: {max_magnitude: 5}}}}\n");
  ASSERT_EQ(skies.size(), 1U);
  EXPECT_EQ(skies[0].faintest, 8);
  EXPECT_EQ(skies[0].stars, 15U);
  EXPECT_GT(skies[0].twice, 0);
  EXPECT_THAT(counted_twice_text(skies[0]), HasSubstr("from V = 6 to 8 are seen twice: as stars"));
}

TEST_F(SkySurveys, ASegmentThatDeepensTheLimitIsSeen) {
  const auto skies = of(kToSix,
                        "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
                        "  - {duration_s: 4, trajectory: {type: static, r: 9}, sky: {region_I: "
                        "{stars: {max_magnitude: 7}}}}\n");
  ASSERT_EQ(skies.size(), 1U);
  EXPECT_EQ(skies[0].faintest, 7);
  EXPECT_GT(skies[0].twice, 0);
}

TEST_F(SkySurveys, EachBackgroundIsHeldAgainstTheLimitsOfItsOwnSegments) {
  const auto skies = of(kToSix,
                        "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
                        "  - {duration_s: 4, trajectory: {type: static, r: 9}, sky: {region_I: "
                        "{background: to_11.sky, stars: {max_magnitude: 9}}}}\n"
                        "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n");
  ASSERT_EQ(skies.size(), 2U);
  EXPECT_EQ(skies[0].map, "to_6.sky");
  EXPECT_THAT(skies[0].segments, ElementsAre(0, 2));
  EXPECT_EQ(skies[0].faintest, 6);
  EXPECT_EQ(skies[0].twice, 0);
  EXPECT_EQ(segments_text(skies[0]), ", in segments 1, 3");
  EXPECT_EQ(skies[1].map, "to_11.sky");
  EXPECT_EQ(skies[1].faintest, 9);
  EXPECT_EQ(skies[1].twice, 0);
  ASSERT_TRUE(skies[1].panorama);
  EXPECT_EQ(segments_text(skies[1]), ", in segment 2");
}

TEST_F(SkySurveys, ASegmentsBackgroundThatHoldsTheStarsIsToldWithItsSegment) {
  const auto skies =
      of("  region_I: {background: to_11.sky, stars: {catalogue: stars.csv, max_magnitude: 9}}\n",
         "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
         "  - {duration_s: 4, trajectory: {type: static, r: 9}, sky: {region_I: {background: "
         "to_6.sky}}}\n");
  ASSERT_EQ(skies.size(), 2U);
  EXPECT_EQ(skies[0].twice, 0);
  EXPECT_GT(skies[1].twice, 0);
  EXPECT_THAT(counted_twice_text(skies[1]), HasSubstr("seen twice, in segment 2: as stars"));
}

TEST_F(SkySurveys, RegionThreeIsToldWhereItIsSeenAndDiffers) {
  const char* both =
      "  region_I: {background: to_6.sky, stars: none}\n"
      "  region_III: {background: to_11.sky, stars: none}\n";
  EXPECT_EQ(of(both, "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n").size(), 1U);
  const auto skies =
      of(both, "  - {duration_s: 4, trajectory: {type: infall, from_r: 3, to_r: 1}}\n");
  ASSERT_EQ(skies.size(), 2U);
  EXPECT_EQ(skies[1].region, SkyRegion::kIII);
}

}  // namespace
}  // namespace domefall
