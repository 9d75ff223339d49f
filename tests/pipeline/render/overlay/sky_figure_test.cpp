// Titles and lines that belong to places on the sky are where the lens shows these.
#include "pipeline/render/overlay/sky_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/render/overlay/frame_titles.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// A show without any other light, whose titles are the figure of two places, or a name at the first.
Show sky_show(const Trajectory& trajectory, const Projection& projection) {
  Show show = show_of(trajectory, projection);
  show.sky[SkyRegion::kI].background = BlackSky{};
  show.sky[SkyRegion::kI].stars.reset();
  return show;
}

Title figure_of(const std::vector<SkyDirection>& line) {
  Title title;
  title.end_s = 1;
  title.place = line.front();
  title.figure = {line};
  return title;
}

// The largest light within so many pixels of where a place is seen.
float light_near(const HalfFrame& frame, const FrameState& state, const CameraDirection& seen,
                 int reach) {
  const auto at = pixel_of(state.projection, seen);
  float most = 0;
  const int x = static_cast<int>(std::lround(at->i)) - 1,
            y = static_cast<int>(std::lround(at->j)) - 1;
  for (int j = y - reach; j <= y + reach; ++j)
    for (int i = x - reach; i <= x + reach; ++i)
      if (i >= 0 && j >= 0 && i < frame.width && j < frame.height)
        most = std::max(most, float(frame.row(j)[3 * i + 1]));
  return most;
}

// The place that is seen so far to the side of straight behind the hole.
SkyDirection beside(const FrameState& state, double degrees, double turn = 0) {
  const M33d& sky = state.observer.sky_from_tetrad;
  const double a = degrees * kDegree;
  const V3d side = column(sky, 1) * std::cos(turn) + column(sky, 2) * std::sin(turn);
  return {column(sky, 0) * -std::cos(a) + side * std::sin(a)};
}

TEST(SkyFigures, GoThroughTheImagesOfTheirPlaces) {
  for (const Trajectory& trajectory :
       {Trajectory(StaticObserver{20}), Trajectory(CircularOrbit{8})}) {
    Show show = sky_show(trajectory, Domemaster{512});
    show.spacetime = Schwarzschild{1e6};
    show.timeline[0].camera.attitude = LookAtHole{};
    const FrameState state = frame_state(show, 0);
    const SkyDirection a = beside(state, 30, 1.4), b = beside(state, 50, 1.7);
    show.titles = {figure_of({a, b})};
    const HalfFrame frame = Renderer(show, 1).render(state);
    const DirectSky sky(state, show.effects);
    ASSERT_TRUE(sky.is_seen());
    for (const double part : {0.2, 0.5, 0.8}) {
      const SkyDirection between{(a.v * (1 - part) + b.v * part).normalized()};
      EXPECT_GT(light_near(frame, state, sky.image(between), 1), 0.3) << part;
    }
    // Stars stand clear.
    EXPECT_EQ(light_near(frame, state, sky.image(a), 0), 0);
    EXPECT_EQ(light_near(frame, state, sky.image(b), 0), 0);
  }
}

// A line that passes behind the hole goes around it on both sides, and not across.
TEST(SkyFigures, AreBrokenBehindTheHole) {
  Show show = sky_show(StaticObserver{20}, Domemaster{512});
  show.spacetime = Schwarzschild{1e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  const FrameState state = frame_state(show, 0);
  show.titles = {figure_of({beside(state, 30), beside(state, 30, std::numbers::pi)})};
  const HalfFrame frame = Renderer(show, 1).render(state);
  const V3d hole = apply_transposed(state.observer.tetrad_from_camera, V3d(-1, 0, 0));
  EXPECT_EQ(light_near(frame, state, {hole}, 12), 0);
  const DirectSky sky(state, show.effects);
  EXPECT_GT(light_near(frame, state, sky.image(beside(state, 10)), 1), 0.3);
  EXPECT_GT(light_near(frame, state, sky.image(beside(state, 10, std::numbers::pi)), 1), 0.3);
}

TEST(SkyFigures, HaveTheirNamesBelowThem) {
  Show show = sky_show(CircularOrbit{8}, Domemaster{512});
  show.spacetime = Schwarzschild{1e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  const FrameState state = frame_state(show, 0);
  Title title;
  title.text = "I";
  title.style.font = "DejaVu Sans";
  title.end_s = 1;
  title.height = 3 * kDegree;
  title.place = beside(state, 40, 1);
  show.titles = {title};
  const HalfFrame frame = Renderer(show, 1).render(state);
  const DirectSky sky(state, show.effects);
  const V3d seen = apply_transposed(state.camera_from_audience, sky.image(*title.place).v);
  const auto at_height = [&](double capitals) {
    const double elevation = std::asin(seen.z) - capitals * title.height,
                 azimuth = std::atan2(seen.x, seen.y);
    const V3d there(std::sin(azimuth) * std::cos(elevation),
                    std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
    return CameraDirection{apply(state.camera_from_audience, there)};
  };
  EXPECT_EQ(light_near(frame, state, at_height(0), 3), 0);
  float most = 0;
  for (double below = 1; below < 2.5; below += 0.1)
    most = std::max(most, light_near(frame, state, at_height(below), 1));
  EXPECT_GT(most, 0.5);
}

}  // namespace
}  // namespace domefall
