#include "pipeline/program/survey/light_survey.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "pipeline/sources/colour/colour_space.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

double mean_light(const HalfFrame& frame, const Projection& projection) {
  double sum = 0;
  int count = 0;
  for (int row = 0; row < frame.height; ++row) {
    const ColumnRange range = inside_columns(projection, row);
    for (int k = range.first; k <= range.last; ++k, ++count) {
      const Imath::half* rgb = frame.row(row) + 3 * k;
      sum += luminance({rgb[0], rgb[1], rgb[2]});
    }
  }
  return sum / count;
}

TEST(LightSurvey, FindsTheBrightestFrameAndKeepsItsMean) {
  Show show = starry(show_of(StaticObserver{12}, Domemaster{256}));
  show.spacetime = Schwarzschild{1e6};
  show.timeline[0].duration_s = 6;
  show.timeline[0].timing.tau_end = 1;
  // The middle is brightest, and the ends are fades.
  show.timeline[0].curves[Channel::kEv] = Curve{{{0, -9}, {2, 0}, {3, 1}, {4, 0.5}, {6, -8}}};
  Renderer renderer(show, 2);
  const LightSurvey found = survey_light(show, renderer, nullptr);
  EXPECT_EQ(found.frames.size(), 7U);
  EXPECT_NEAR(found.brightest.time_s, 3, 0.1);
  EXPECT_LT(found.darkest.mean, found.brightest.mean);
  EXPECT_GE(found.darkest.ev, found.brightest.ev - 3);
  EXPECT_GT(found.brightest.percentile99, found.brightest.mean);
  // A frame of 256 pixels has the same mean.
  const HalfFrame large = renderer.render(frame_state(show, found.brightest.frame));
  EXPECT_NEAR(found.brightest.mean / mean_light(large, show.projection), 1, 0.1);
}

// Blobs of a small frame are so wide that faint stars drop below what is drawn at all.
TEST(LightSurvey, SeesTheLightOfFaintStarsByFewerBrighterOnes) {
  Show show = starry(show_of(StaticObserver{12}, Domemaster{512}));
  show.spacetime = Schwarzschild{1e6};
  show.sky[SkyRegion::kI].background = BlackSky{};
  show.sky[SkyRegion::kI].stars->max_magnitude = 9;
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  show.timeline[0].timing.tau_end = 1e-3;
  Renderer small(show, 2, {}, kSurveyDetail), large(show, 2);
  const LightSurvey found = survey_light(show, small, nullptr);
  const HalfFrame frame = large.render(frame_state(show, 0));
  EXPECT_NEAR(found.brightest.mean / mean_light(frame, show.projection), 1, 0.05);
}

// Who crosses the plane of a disc within its rims sees its light jump there, and nowhere else.
TEST(LightWarnings, FindTheCrossingOfADisc) {
  Show show = show_of(CircularOrbit{12}, Domemaster{256});
  show.spacetime = Schwarzschild{1e6};
  show.timeline[0].duration_s = 8;
  show.timeline[0].timing.tau_end = 120;
  show.timeline[0].curves[Channel::kEv] = Curve{{{0, -6}, {1, 0}, {8, 0}}};
  show.timeline[0].camera.attitude = LookAtHole{};
  Renderer plain(show, 2);
  // It is dark there.
  const auto alone = light_warnings(show, plain, survey_light(show, plain, nullptr));
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_TRUE(alone[0].text.starts_with("the picture is black for"));
  show.disc = Disc{};
  const auto height = [&](int frame) {
    const M33d& axes = frame_state(show, frame).observer.sky_from_tetrad;
    return column(axes, 0).dot(show.disc->normal.v);
  };
  // The plane holds the place of frame 100.5, so that it is crossed before frame 101.
  const M33d axes = frame_state(show, 100).observer.sky_from_tetrad;
  const M33d next = frame_state(show, 101).observer.sky_from_tetrad;
  const V3d place = (column(axes, 0) + column(next, 0)).normalized();
  const V3d north = -column(axes, 1);
  show.disc->normal = {(north + place.cross(north) * 0.6).normalized()};
  show.disc->node = {place};
  ASSERT_LT(height(100) * height(101), 0);
  Renderer renderer(show, 2);
  const auto warnings = light_warnings(show, renderer, survey_light(show, renderer, nullptr));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].frame, 101);
  EXPECT_NE(warnings[0].text.find("the mean light jumps from"), std::string::npos);
}

TEST(LightWarnings, FindWhatIsBlackOrTheSameForLong) {
  Show show = starry(show_of(StaticObserver{12}, Domemaster{128}));
  show.spacetime = Schwarzschild{1e6};
  show.timeline[0].duration_s = 40;
  show.timeline[0].timing.tau_end = 1;
  show.timeline[0].curves[Channel::kEv] = Curve{{{0, -30}, {6, -30}, {8, 6}, {40, 6}}};
  Renderer renderer(show, 2, {}, kSurveyDetail);
  const auto texts = [&] {
    std::vector<std::string> found;
    for (const ShowWarning& warning :
         light_warnings(show, renderer, survey_light(show, renderer, nullptr)))
      found.push_back(fmt::format("{:.0f}: {}", warning.time_s, warning.text));
    return found;
  };
  const auto found = texts();
  ASSERT_EQ(found.size(), 2U) << fmt::format("{}", fmt::join(found, "\n"));
  EXPECT_TRUE(found[0].starts_with("0: the picture is black for"));
  EXPECT_NE(found[1].find("the picture is nearly the same for"), std::string::npos);
  // A fade from black is meant, and less than 20 seconds of one picture are no tableau.
  show.timeline[0].curves[Channel::kEv] = Curve{{{0, 6}}};
  show.timeline[0].fades.in_s = 10;
  show.timeline[0].duration_s = 18;
  const auto none = texts();
  EXPECT_TRUE(none.empty()) << fmt::format("{}", fmt::join(none, "\n"));
}

}  // namespace
}  // namespace domefall
