#include "pipeline/program/preview/screen_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/pipeline/show/show_file.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

class ScreenView : public ShowFile {
 protected:
  Show with(const std::string& camera, const std::string& size = "256") {
    return read("black_hole: {mass_solar: 10}\nsize: " + size + "\ncamera: " + camera +
                "\ntimeline: [{duration_s: 5, trajectory: {type: circular, r: 8, orbits: 1}}]\n");
  }
};

// The direction, along the audience's axes, of a pixel position.
V3d for_audience(const FrameState& state, PixelPosition at) {
  return apply_transposed(state.camera_from_audience, direction_at(state.projection, at).v);
}

// The same along the axes of the tetrad, which do not depend on the view.
V3d in_tetrad(const FrameState& state, PixelPosition at) {
  return apply(state.observer.tetrad_from_camera, direction_at(state.projection, at).v);
}

void expect_near(const V3d& a, const V3d& b) { EXPECT_LT((a - b).length(), 1e-12) << a; }

constexpr Stereographic kScreen{321, 181, 100 * kDegree};
constexpr PixelPosition kMiddle{161, 91};

TEST_F(ScreenView, OfTurnedDomesLooksUpTheFrontFromTheSeats) {
  const Show show = with("{euler_deg: [20, 100, -50]}");
  const FrameState dome = frame_state(show, 30);
  FrameState state = dome;
  see_in(show, kScreen, state);
  const double half = std::numbers::sqrt2 / 2;
  expect_near(for_audience(state, kMiddle), {0, half, half});
  // The place on the dome that is 45 degrees above the front is the middle of the screen.
  expect_near(in_tetrad(state, kMiddle), in_tetrad(dome, {128.5, 128.5 + 64}));
  FrameState turned = state;
  turn_to({0, 45, 0}, turned);
  for (const PixelPosition at : {kMiddle, PixelPosition{1, 1}, PixelPosition{300, 20}})
    expect_near(in_tetrad(turned, at), in_tetrad(state, at));
}

TEST_F(ScreenView, TurnsToAzimuthAltitudeAndRoll) {
  const Show show = with("{look_at: hole}");
  FrameState state = frame_state(show, 30);
  see_in(show, kScreen, state);
  const FrameState before = state;
  turn_to({30, 20, 0}, state);
  const double c = std::cos(20 * kDegree);
  expect_near(for_audience(state, kMiddle),
              {c * std::sin(30 * kDegree), c * std::cos(30 * kDegree), std::sin(20 * kDegree)});
  EXPECT_NEAR(for_audience(state, {321, 91}).z, for_audience(state, {1, 91}).z, 1e-12);
  EXPECT_GT(for_audience(state, {161, 1}).z, std::sin(20 * kDegree)) << "up is up";
  const V3d right = for_audience(state, {321, 91});
  turn_to({30, 20, 90}, state);
  expect_near(for_audience(state, {161, 91 - 160}), right);
  // What the audience has somewhere stays where it is on the sky.
  const M33d audience = before.observer.tetrad_from_camera * before.camera_from_audience;
  const M33d after = state.observer.tetrad_from_camera * state.camera_from_audience;
  for (int k = 0; k < 3; ++k) expect_near(column(audience, k), column(after, k));
}

TEST_F(ScreenView, OfTheWholeSphereHasTheFrontInItsMiddle) {
  const Show show = with("{look_at: hole, dome_tilt_deg: 20}");
  FrameState state = frame_state(show, 3);
  see_in(show, Equirectangular{400}, state);
  expect_near(for_audience(state, {200.5, 100.5}), {0, 1, 0});
  expect_near(for_audience(state, {300.5, 100.5}), {1, 0, 0});
  expect_near(for_audience(state, {200.5, 0.5}), {0, 0, 1});
}

TEST_F(ScreenView, IsWrittenAsACameraThatSeesTheSame) {
  for (const char* camera :
       {"{look_at: hole}", "{euler_deg: [20, 100, -50], dome_tilt_deg: 15}",
        "{look_at: motion, dome_tilt_deg: 25}", "{projection: stereographic, look_at: motion}"}) {
    const bool flat = std::string(camera).find("stereographic") != std::string::npos;
    const std::string size = flat ? "[64, 36]" : "256";
    const Show show = with(camera, size);
    for (const ScreenLook& look : {ScreenLook{}, ScreenLook{-70, 10, 30}, ScreenLook{180, 90, 0}}) {
      FrameState state = frame_state(show, 40), in_dome = state;
      see_in(show, kScreen, state);
      turn_to(look, state);
      see_in(show, Domemaster{100}, in_dome);
      turn_to(look, in_dome);
      for (std::string line :
           {camera_as_yaml(show, state, true), camera_as_yaml(show, in_dome, true)}) {
        if (flat) line.replace(0, 1, "{projection: stereographic, ");
        const Show other = with(line, size);
        FrameState again = frame_state(other, 40);
        see_in(other, kScreen, again);
        for (const PixelPosition at : {kMiddle, PixelPosition{1, 1}})
          EXPECT_LT((in_tetrad(again, at) - in_tetrad(state, at)).length(), 2e-5) << camera << line;
      }
    }
  }
}

TEST_F(ScreenView, OfTheShowsOwnCameraIsWrittenWithItsTarget) {
  for (const char* camera : {"{look_at: hole, elevation_deg: 30}",
                             "{look_at: {ra_deg: 20, dec_deg: -40}, "
                             "elevation_deg: 60, roll_deg: 12, dome_tilt_deg: 15}",
                             "{look_at: motion, elevation_deg: 45}"}) {
    const Show show = with(camera, "256");
    FrameState state = frame_state(show, 40);
    see_in(show, kScreen, state);
    EXPECT_EQ(camera_as_yaml(show, state, false), camera);
  }
  const Show angles = with("{euler_deg: [20, 100, -50]}", "256");
  EXPECT_EQ(camera_as_yaml(angles, frame_state(angles, 40), false), "{euler_deg: [20, 100, -50]}");
}

}  // namespace
}  // namespace domefall
