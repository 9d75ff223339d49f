#include "pipeline/report/frame_timing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace domefall {
namespace {

GradedFrame even_frame(int size, std::uint16_t value) {
  GradedFrame frame(size, size);
  std::fill(frame.pixels.begin(), frame.pixels.end(), value);
  return frame;
}

TEST(FrameDifference, IsTheRootOfTheMeanSquareAndTheWorst) {
  const Projection flat = Stereographic{4, 4, 1};
  const GradedFrame black = even_frame(4, 0);
  GradedFrame one_white = black;
  one_white.row(2)[5] = 65535;
  const FrameDifference d = difference(one_white, black, flat);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(1.0 / 48));
  EXPECT_DOUBLE_EQ(d.worst, 1);
}

TEST(FrameDifference, LeavesOutWhatIsOutsideTheDome) {
  const GradedFrame black = even_frame(16, 0);
  GradedFrame corner = black;
  corner.row(0)[0] = 65535;
  EXPECT_EQ(difference(corner, black, Domemaster{16}).worst, 0);
  EXPECT_EQ(difference(corner, black, Stereographic{16, 16, 1}).worst, 1);
}

TEST(TimedFrames, AreThoseThatTheRendererMakes) {
  Show show;
  show.projection = Domemaster{64};
  show.sky[SkyRegion::kI].background = GridSky{};
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = StaticObserver{10};
  show.timeline = {segment};
  const TimedFrame timed = time_frame(show, {2, false}, 1, {3, 1});
  const HalfFrame frame = Renderer(show, 1, {2, false}).render(frame_state(show, 0));
  ASSERT_EQ(timed.frame.pixels.size(), frame.pixels.size());
  for (std::size_t k = 0; k < frame.pixels.size(); ++k)
    ASSERT_EQ(timed.frame.pixels[k].bits(), frame.pixels[k].bits());
  EXPECT_GT(timed.seconds, 0);
  EXPECT_TRUE(std::isfinite(timed.seconds));
  EXPECT_GT(copy_seconds(timed.frame), 0);
}

}  // namespace
}  // namespace domefall
