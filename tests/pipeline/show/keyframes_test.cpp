// Tests of what changes during a show: cameras, exposure, skies.

#include "pipeline/light/aberration.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/frame_state.h"
#include "tests/pipeline/show/show_file.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

class Keyframes : public ShowFile {
 protected:
  Show show(const std::string& text) { return read("black_hole: {mass_solar: 4e6}\n" + text); }
};

// The angle (radians) by which one camera has turned into another.
double angle_between(const M33d& a, const M33d& b) {
  return turn_between(a, b, V3d(0, 0, 0)).length();
}

double largest_turn_per_frame(const Show& s) {
  double largest_turn = 0;
  M33d before = frame_state(s, 0).observer.tetrad_from_camera;
  for (int frame = 1; frame < frame_count(s); ++frame) {
    const M33d now = frame_state(s, frame).observer.tetrad_from_camera;
    largest_turn = std::max(largest_turn, angle_between(before, now));
    before = now;
  }
  return largest_turn;
}

TEST_F(Keyframes, ValuesComeFromTheNearestThatSaysThem) {
  const Show s = show(
      "frames_per_second: 1\n"
      "exposure: {ev: 1}\n"
      "keyframes: [{at_s: 2, exposure: {ev: 3}}]\n"
      "timeline:\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}, exposure: {ev: -5}}\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}, keyframes: [{at_s: 2, exposure: {ev: "
      "7}}]}\n");
  const auto ev = [&](int frame) { return frame_state(s, frame).settings.ev; };
  EXPECT_DOUBLE_EQ(ev(0), 1);  // the show's own value is there without keyframes
  EXPECT_DOUBLE_EQ(ev(1), 2);
  EXPECT_DOUBLE_EQ(ev(3), 3);
  EXPECT_DOUBLE_EQ(ev(4), -5);
  EXPECT_DOUBLE_EQ(ev(5), -5);
  EXPECT_DOUBLE_EQ(ev(6), 3);  // from the show's keyframes to the segment's
  EXPECT_DOUBLE_EQ(ev(7), 5);
  EXPECT_DOUBLE_EQ(ev(9), 7);
}

TEST_F(Keyframes, DiscsAndBodiesChange) {
  const Show s = show(
      "frames_per_second: 1\n"
      "disc: {luminance_cd_m2: 0.003, opacity: 0.8}\n"
      "bodies: {near: {r: 8, magnitude: -2}, far: {r: 20, magnitude: 5}}\n"
      "keyframes: [{at_s: 4, ease: linear, disc: {opacity: 0}, bodies: {far: {magnitude: 9}}}]\n"
      "timeline:\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}, disc: {luminance_cd_m2: 0.002, "
      "opacity: "
      "1}, bodies: {near: {magnitude: 3}}}\n");
  const auto at = [&](int frame) { return frame_state(s, frame).settings; };
  EXPECT_EQ(at(0).disc_gain, 1);
  EXPECT_DOUBLE_EQ(at(1).disc_opacity, 0.6);
  EXPECT_DOUBLE_EQ(bodies_at(s, at(1))[1].magnitude, 6);
  EXPECT_EQ(bodies_at(s, at(1))[0].magnitude, -2);
  EXPECT_DOUBLE_EQ(at(4).disc_gain, 2.0 / 3);
  EXPECT_EQ(at(4).disc_opacity, 1);
  EXPECT_EQ(bodies_at(s, at(4))[0].magnitude, 3);
  EXPECT_EQ(bodies_at(s, at(4))[1].magnitude, 9);
}

TEST_F(Keyframes, TheLightOfTitlesChangesAndIsMixedInADissolve) {
  const Show s = show(
      "frames_per_second: 1\n"
      "keyframes: [{at_s: 4, ease: linear, title_light: {gain: 0.2}}]\n"
      "timeline:\n"
      "  - {duration_s: 6, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 4, dissolve_s: 2, trajectory: {type: static, r: 9}, title_light: {gain: 3, "
      "opacity: 0.4}}\n");
  const auto at = [&](int frame) { return frame_state(s, frame).settings; };
  EXPECT_EQ(at(0).title_gain, 1);
  EXPECT_EQ(at(0).title_opacity, 1);
  EXPECT_DOUBLE_EQ(at(2).title_gain, 0.6);
  EXPECT_NEAR(at(4).title_gain, 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(at(5).title_gain, 1.6) << "half way in the dissolve";
  EXPECT_DOUBLE_EQ(at(5).title_opacity, 0.7);
  EXPECT_DOUBLE_EQ(at(7).title_gain, 3);
  EXPECT_DOUBLE_EQ(at(7).title_opacity, 0.4);
  EXPECT_NE(complaint("timeline: [{duration_s: 1, title_light: {gain: 7}}]\n")
                .find("title_light.gain must be at most 6"),
            std::string::npos);
}

TEST_F(Keyframes, SkiesAndFieldsOfViewChange) {
  const Show s = show(
      "frames_per_second: 1\nsize: [32, 32]\n"
      "camera: {projection: stereographic, fov_deg: 90}\n"
      "keyframes:\n"
      "  - {at_s: 2, camera: {fov_deg: 30}, sky: {region_I: {gain: 3, stars: {gain: 2, "
      "max_magnitude: 4.5}}, region_III: {gain: 0}, region_IV: {gain: 5}}}\n"
      "timeline:\n"
      "  - {duration_s: 3, trajectory: {type: static, r: 9}}\n");
  const FrameState f = frame_state(s, 1);
  EXPECT_DOUBLE_EQ(std::get<Stereographic>(f.projection).fov, 60 * kDegree);
  EXPECT_DOUBLE_EQ(f.settings.sky[SkyRegion::kI].background_gain, 2);
  EXPECT_DOUBLE_EQ(f.settings.sky[SkyRegion::kI].star_gain, 1.2);  // from 0.4 to 2
  EXPECT_DOUBLE_EQ(f.settings.sky[SkyRegion::kI].max_magnitude, 6.75);
  EXPECT_TRUE(f.settings.sky[SkyRegion::kI].soft_limit);
  EXPECT_DOUBLE_EQ(f.settings.sky[SkyRegion::kIII].background_gain, 0.5);
  EXPECT_FALSE(f.settings.sky[SkyRegion::kIII].soft_limit);
  EXPECT_DOUBLE_EQ(f.settings.sky[SkyRegion::kIV].background_gain, 3);
  EXPECT_DOUBLE_EQ(std::get<Stereographic>(frame_state(s, 2).projection).fov, 30 * kDegree);
}

TEST_F(Keyframes, OpeningAnglesOfEachKindChange) {
  for (const char* projection : {"rectilinear", "fisheye"}) {
    const Show s = show(
        "frames_per_second: 1\nsize: [32, 32]\ncamera: {projection: " + std::string(projection) +
        ", fov_deg: 90}\n"
        "keyframes: [{at_s: 2, camera: {fov_deg: 30}}]\n"
        "timeline:\n"
        "  - {duration_s: 3, trajectory: {type: static, r: 9}}\n");
    EXPECT_NEAR(field_of_view(frame_state(s, 1).projection).value(), 60 * kDegree, 1e-15);
    EXPECT_NEAR(field_of_view(frame_state(s, 2).projection).value(), 30 * kDegree, 1e-15);
  }
}

TEST_F(Keyframes, TheCdlChangesWithSegmentsAndKeyframes) {
  const Show s = show(
      "frames_per_second: 1\n"
      "grade: {cdl: {slope: [1.2, 1, 0.8], offset: 0.1}}\n"
      "timeline:\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}, grade: {cdl: {slope: 2, power: 3}}}\n"
      "  - duration_s: 4\n"
      "    trajectory: {type: static, r: 9}\n"
      "    keyframes: [{at_s: 2, grade: {cdl: {offset: [0.3, 0.5, 0.1], saturation: 0.5}}}]\n");
  using Colours = std::array<double, 3>;
  const FrameState plain = frame_state(s, 0), own = frame_state(s, 3);
  EXPECT_EQ(plain.cdl, s.grade.cdl);
  EXPECT_EQ(own.cdl.slope, (Colours{2, 2, 2}));
  EXPECT_EQ(own.cdl.offset, (Colours{0.1, 0.1, 0.1})) << "what a segment does not name stays";
  EXPECT_EQ(own.cdl.power, (Colours{3, 3, 3}));
  const FrameState first = frame_state(s, 6), between = frame_state(s, 7), last = frame_state(s, 9);
  EXPECT_EQ(first.cdl, s.grade.cdl);
  EXPECT_DOUBLE_EQ(between.cdl.offset[0], 0.2);
  EXPECT_DOUBLE_EQ(between.cdl.offset[1], 0.3);
  EXPECT_DOUBLE_EQ(between.cdl.offset[2], 0.1);
  EXPECT_DOUBLE_EQ(between.cdl.saturation, 0.75);
  EXPECT_EQ(between.cdl.slope, (Colours{1.2, 1, 0.8}));
  EXPECT_DOUBLE_EQ(last.cdl.offset[1], 0.5);
}

TEST_F(Keyframes, ADissolveMixesTheCdlsOfItsSegments) {
  const Show s = show(
      "frames_per_second: 1\n"
      "timeline:\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 6, dissolve_s: 2, trajectory: {type: static, r: 9}, grade: {cdl: "
      "{saturation: 0.5}}}\n");
  EXPECT_EQ(frame_state(s, 1).cdl.saturation, 1);
  EXPECT_DOUBLE_EQ(frame_state(s, 3).cdl.saturation, 0.75);
  EXPECT_DOUBLE_EQ(frame_state(s, 5).cdl.saturation, 0.5);
}

TEST_F(Keyframes, ARollIsAsManyTurnsAsItSays) {
  const Show s = show(
      "timeline:\n"
      "  - {duration_s: 4, trajectory: {type: static, r: 9}, keyframes: [{at_s: 4, ease: linear, "
      "camera: {roll_deg: 720}}]}\n");
  EXPECT_NEAR(largest_turn_per_frame(s), 720.0 / 120 * kDegree, 1e-9);
}

TEST_F(Keyframes, CamerasStandWhereTheirKeysSay) {
  const Show s = show(
      "frames_per_second: 10\n"
      "cameras: {up: {look_at: Vega, elevation_deg: 90}}\n"
      "timeline:\n"
      "  - duration_s: 6\n"
      "    trajectory: {type: circular, r: 7, orbits: 1}\n"
      "    keyframes:\n"
      "      - {at_s: 1, name: start, camera: {look_at: motion}}\n"
      "      - {at_s: 2, camera: up}\n"
      "      - {at_s: 3, camera: {euler_deg: [10, 20, 30]}}\n"
      "      - {at_s: 4, camera: {look_at: {keyframe: start}, elevation_deg: 45}}\n"
      "      - {at_s: 5, ease: hold, camera: {look_at: outward}}\n");
  const auto expect_like = [&](int frame, const Attitude& attitude, double elevation_deg) {
    const FrameState f = frame_state(s, frame);
    const Camera camera{.attitude = attitude, .elevation = elevation_deg * kDegree};
    EXPECT_LT(angle_between(camera_axes(camera, f.projection, f.observer, s.effects),
                            f.observer.tetrad_from_camera),
              1e-12)
        << frame;
  };
  const auto& vega = std::get<LookAtSky>(s.timeline[0].attitudes[2].attitude);
  expect_like(0, LookAtHole{}, 45);
  expect_like(10, LookAlongMotion{}, 67.5);  // on its way from 45 to 90
  expect_like(20, vega, 90);
  expect_like(30, EulerAngles{10 * kDegree, 20 * kDegree, 30 * kDegree}, 0);
  expect_like(40, LookAlongMotion{}, 45);
  expect_like(49, LookAlongMotion{}, 45);
  expect_like(50, LookOutward{}, 45);
  expect_like(59, LookOutward{}, 45);
}

// The targets move against each other, even by whole turns, and no way from one to the other jumps.
// With twice the frames a second every step is about half as large.
TEST_F(Keyframes, CamerasTurnWithoutAJump) {
  const auto turning = [this](const std::string& keys, int rate) {
    return show("frames_per_second: " + std::to_string(rate) +
                "\ntimeline:\n"
                "  - duration_s: 8\n"
                "    trajectory: {type: circular, r: 6, orbits: 2.5}\n"
                "    keyframes: [" +
                keys + "]\n");
  };
  for (const std::string keys :
       {"{at_s: 7, camera: {look_at: Vega}}", "{at_s: 8, camera: {euler_deg: [100, 200, 300]}}",
        "{at_s: 0, camera: {look_at: Sirius}}, {at_s: 8, camera: {look_at: outward}}",
        "{at_s: 1, camera: {look_at: outward}}, {at_s: 7, camera: {look_at: hole}}",
        "{at_s: 0, camera: {look_at: Vega}}, {at_s: 6, camera: {look_at: Betelgeuse, roll_deg: "
        "180}}"}) {
    const double coarse = largest_turn_per_frame(turning(keys, 60));
    const double fine = largest_turn_per_frame(turning(keys, 120));
    EXPECT_LT(coarse, 20 * kDegree) << keys;
    EXPECT_LT(fine, 0.6 * coarse) << keys;
  }
}

// Out of region IV, where no sky is seen, a star comes up straight ahead.
TEST_F(Keyframes, ACameraFindsItsStarAtThePastHorizon) {
  const auto fastest = [this](int rate) {
    const Show s =
        show("frames_per_second: " + std::to_string(rate) +
             "\ncamera: {look_at: Vega}\n"
             "timeline: [{duration_s: 2, trajectory: {type: kruskal, from_r: 1.9, to_r: 2.3}}]\n");
    return largest_turn_per_frame(s);
  };
  EXPECT_LT(fastest(120), 0.6 * fastest(60));
}

TEST(Turns, AreTheRotationBetweenTwoCameras) {
  const V3d axis = V3d(1, -2, 0.5).normalized();
  const M33d start = turned_by(M33d(), V3d(0.3, 0.2, -0.9));
  for (double angle = -9; angle < 9; angle += 0.37) {
    const M33d end = turned_by(start, axis * angle);
    const V3d found = turn_between(start, end, axis * (angle + 0.2));
    EXPECT_LT((found - axis * angle).length(), 1e-7) << angle;
    EXPECT_LT(angle_between(turned_by(start, found), end), 1e-7) << angle;
  }
  EXPECT_EQ(turn_between(start, start, V3d(0, 0, 0)).length(), 0);
}

}  // namespace
}  // namespace domefall
