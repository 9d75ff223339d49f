#include "pipeline/program/survey/light_survey.h"

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
  EXPECT_EQ(found.frames, 7);
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

}  // namespace
}  // namespace domefall
