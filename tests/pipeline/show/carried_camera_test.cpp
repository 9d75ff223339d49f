// Cameras that keep their direction.
#include <cmath>
#include <numbers>

#include "pipeline/show/attitude.h"
#include "pipeline/show/frame_state.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using std::numbers::pi;

class CarriedCameras : public ShowFile {
 protected:
  static M33d on_stars(const Show& s, int frame) {
    const ObserverState o = frame_state(s, frame).observer;
    return o.sky_from_tetrad * o.tetrad_from_camera;
  }
  static double apart(const M33d& a, const M33d& b) {
    const M33d turn = a.transposed() * b;
    return std::acos(std::clamp((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2, -1.0, 1.0));
  }
};

// A revolution in ten segments leads to de Sitter's angle.
TEST_F(CarriedCameras, GyroscopesPrecessAboutAHoleWithoutSpin) {
  for (const char* hole : {"mass_solar: 4e6", "mass_solar: 4e6, charge: 1e-6"}) {
    std::string yaml = "black_hole: {" + std::string(hole) +
                       "}\nframes_per_second: 10\ncamera: {look_at: hole, frame: gyroscope}\n"
                       "timeline:\n";
    for (int k = 0; k < 10; ++k)
      yaml += "  - {duration_s: 1, trajectory: {type: circular, r: 6, orbits: 0.1}}\n";
    const Show s =
        read(yaml + "  - {duration_s: 1, trajectory: {type: circular, r: 6, orbits: 0}}\n");
    EXPECT_NEAR(apart(on_stars(s, 0), on_stars(s, 100)), 2 * pi * (1 - std::sqrt(0.5)), 1e-8)
        << hole;
    // The joints of a show only make it quicker.
    Show plain = s;
    plain.joints.clear();
    EXPECT_LT(apart(on_stars(s, 57), on_stars(plain, 57)), 1e-7);
  }
}

TEST_F(CarriedCameras, HoldsAgainstTheStarsUntilASegmentAimsAnew) {
  const Show s = read(
      "black_hole: {mass_solar: 4e6, spin: 0.9}\nframes_per_second: 10\n"
      "camera: {look_at: hole, frame: stars}\ntimeline:\n"
      "  - {duration_s: 2, trajectory: {type: bound, periastron: 6, apoastron: 9, inclination_deg: "
      "90, rate_m_per_s: 30}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 30}}\n"
      "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 30}, camera: {look_at: "
      "outward}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n");
  for (const int frame : {5, 19, 20, 39})
    EXPECT_LT(apart(on_stars(s, 0), on_stars(s, frame)), 1e-7);
  EXPECT_GT(apart(on_stars(s, 39), on_stars(s, 40)), 0.1);
  EXPECT_LT(apart(on_stars(s, 40), on_stars(s, 59)), 1e-7);
  EXPECT_GT(apart(on_stars(s, 59), on_stars(s, 60)), 0.1);
}

TEST_F(CarriedCameras, WhatCarriesNoGyroscopeIsTold) {
  const auto told = [&](const std::string& hole, const std::string& trajectory) {
    return complaint(hole +
                     "camera: {frame: gyroscope}\ntimeline:\n  - {duration_s: 2, trajectory: " +
                     trajectory + "}\n");
  };
  const std::string hole = "black_hole: {mass_solar: 4e6}\n";
  EXPECT_NE(told(hole, "{type: velocity, r: 6, speed: 0}").find("held carries no gyroscope"),
            std::string::npos);
  EXPECT_NE(told(hole, "{type: kruskal}").find("from region III or IV"), std::string::npos);
  EXPECT_NE(told("", "{type: static}").find("near holes only"), std::string::npos);
  EXPECT_EQ(told(hole, "{type: infall, from_r: 9}"), "");
  EXPECT_EQ(told(hole, "{type: spiral, from_r: 9}"), "");
  EXPECT_NE(complaint(hole + "timeline:\n  - {duration_s: 2, trajectory: {type: circular, r: 9}, "
                             "keyframes: [{at_s: 1, camera: {frame: stars}}]}\n")
                .find("has a frame, which is of the camera of a show or a segment"),
            std::string::npos);
}

}  // namespace
}  // namespace domefall
