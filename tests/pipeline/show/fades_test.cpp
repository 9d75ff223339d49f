// Tests of fades from and to black, and of backgrounds that change from segment to segment.
#include "pipeline/show/assets.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Fading = ShowMistakes;

TEST_F(Fading, ShowsAndSegmentsRiseFromBlackAndSinkToIt) {
  const Show show = read(
      "frames_per_second: 10\n"
      "fade_in_s: 2\n"
      "fade_out_s: 0:01\n"
      "timeline:\n"
      "  - {duration_s: 5, fade_out_s: 1}\n"
      "  - {duration_s: 5, fade_in_s: 0.5}\n");
  const auto light = [&](int frame) { return frame_state(show, frame).fade; };
  EXPECT_EQ(light(0), 0);
  EXPECT_NEAR(light(10), 0.25, 1e-12) << "half way a quarter of the light looks half as bright";
  EXPECT_EQ(light(20), 1);
  EXPECT_EQ(light(39), 1);
  EXPECT_NEAR(light(45), 0.25, 1e-9);
  EXPECT_LT(light(49), 1e-4);
  EXPECT_EQ(light(50), 0);
  EXPECT_EQ(light(55), 1);
  EXPECT_NEAR(light(95), 0.25, 1e-9);
  EXPECT_LT(light(99), 1e-4);
  for (int frame = 1; frame < 20; ++frame) EXPECT_GT(light(frame), light(frame - 1));
}

TEST_F(Fading, EachSegmentOfADissolveFadesByItself) {
  const Show show = read(
      "frames_per_second: 10\n"
      "timeline:\n"
      "  - {duration_s: 5, fade_out_s: 2}\n"
      "  - {duration_s: 5, dissolve_s: 2}\n");
  const FrameState state = frame_state(show, 40);
  EXPECT_EQ(state.fade, 1);
  ASSERT_TRUE(state.vanishing);
  EXPECT_NEAR(state.vanishing->fade, 0.25, 1e-9);
}

TEST_F(Fading, MistakesInThemAreTold) {
  expect_complaints({
      {"timeline: [{duration_s: 2, fade_in_s: 1, fade_out_s: 1.5}]\n",
       "1:54: timeline[1].fade_out_s makes 2.5 s of fades, but the segment lasts 2 s"},
      {"timeline: [{duration_s: 2}]\nfade_in_s: 3\n",
       "2:12: fade_in_s makes 3 s of fades, but the show lasts 2 s"},
      {"timeline: [{duration_s: 2, fade_in_s: -1}]\n",
       "1:39: timeline[1].fade_in_s must be at least 0 (seconds), got -1"},
  });
}

TEST_F(Fading, BackgroundsOfSegmentsStandForTheShows) {
  write("a.png", ""), write("b.png", "");
  const Show show = read(
      "sky: {region_I: {background: a.png, white_cd_m2: 2e-4}}\n"
      "timeline:\n"
      "  - {duration_s: 1}\n"
      "  - {duration_s: 1, sky: {region_I: {background: b.png, gain: 2}, region_III: {background: "
      "grid}}}\n"
      "  - {duration_s: 1, sky: {region_I: {white_cd_m2: 4e-4}, region_IV: {background: rings, "
      "period_m: 7}}}\n"
      "  - {duration_s: 1, sky: {region_I: {background: milky_way}}}\n");
  const auto panorama = [&](int segment) {
    return std::get<PanoramaSky>(background_of(show, segment, SkyRegion::kI));
  };
  EXPECT_EQ(panorama(0), (PanoramaSky{folder_ / "a.png", 2e-4 / 1e-4}));
  EXPECT_EQ(panorama(1).image, folder_ / "b.png");
  EXPECT_DOUBLE_EQ(panorama(1).brightness, 10) << "white is pixel value 1 where nothing is said";
  EXPECT_TRUE(std::holds_alternative<GridSky>(background_of(show, 1, SkyRegion::kIII)));
  EXPECT_EQ(panorama(2).image, folder_ / "a.png");
  EXPECT_DOUBLE_EQ(panorama(2).brightness, 4);
  EXPECT_EQ(std::get<RingsSky>(background_of(show, 2, SkyRegion::kIV)).period, 7);
  EXPECT_EQ(panorama(3), PanoramaSky{shipped_asset(kMilkyWay)});
  EXPECT_EQ(panorama(3).brightness, 1) << "the shipped map has a unit of its own";
  EXPECT_EQ(frame_state(show, 30).settings.sky[SkyRegion::kI].background_gain, 2);
  // Region III is like region I of the show, not of the segment.
  EXPECT_EQ(std::get<PanoramaSky>(background_of(show, 2, SkyRegion::kIII)).brightness, 2);
}

TEST_F(Fading, MistakesInBackgroundsOfSegmentsAreTold) {
  write("a.png", "");
  const auto sky = [](const std::string& text) {
    return "timeline: [{duration_s: 2, sky: {" + text + "}}]\n";
  };
  expect_complaints({
      {sky("region_I: {background: a.png, white_cd_m2: 0}"),
       "1:77: timeline[1].sky.region_I.white_cd_m2 must exceed 0 (cd/m^2), got 0"},
      {sky("region_I: {background: grid, white_cd_m2: 1}"),
       "1:76: timeline[1].sky.region_I.white_cd_m2 is the white of an image; this background has "
       "its own light, see gain"},
      {sky("region_I: {background: c.png}"),
       "1:57: timeline[1].sky.region_I.background names the file 'c.png', which is neither beside "
       "the show nor in the working folder"},
      {sky("region_IV: {period_m: 3}"),
       "1:56: timeline[1].sky.region_IV.period_m is the period of rings; the background must be "
       "rings"},
      {"timeline: [{duration_s: 2}]\nkeyframes: [{at_s: 1, sky: {region_I: {background: grid}}}]\n",
       "2:40: keyframes[1].sky.region_I.background is an unknown key; known here: gain or stars"},
      {sky("region_I: {background: grid, stars: {catalogue: a.csv}}"),
       "1:71: timeline[1].sky.region_I.stars.catalogue is an unknown key; known here: "
       "max_magnitude or gain"},
  });
}

}  // namespace
}  // namespace domefall
