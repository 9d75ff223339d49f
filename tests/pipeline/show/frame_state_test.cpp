#include "pipeline/show/frame_state.h"

#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/show/placement.h"
#include "tests/pipeline/show/show_file.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

// This allows for a dozen roundings of numbers of size 1.
constexpr double kStateRounding = 1e-14;

class FrameStates : public ObservedShow {
 protected:
  // A frame of a segment of one second.
  FrameState frame(const std::string& trajectory, const std::string& camera = "", int number = 0) {
    return frame_state(
        show("  - {duration_s: 1, trajectory: " + trajectory + "}\n", "camera: {" + camera + "}\n"),
        number);
  }
};

void expect_close(const V3d& a, const V3d& b, double tolerance = kStateRounding) {
  EXPECT_LE((a - b).length(), tolerance) << a << " and " << b;
}

// The direction, in the boosted tetrad, that a dome shows at an elevation above the front of its
// rim.
V3d at_front(const FrameState& s, double elevation) {
  const M33d& m = s.observer.tetrad_from_camera;
  return column(m, 1) * std::cos(elevation) + column(m, 2) * std::sin(elevation);
}

V3d hole_seen(const ObserverState& o) { return to_observer(o.celerity, V3d(-1, 0, 0)).direction; }

// ---- time ----

TEST_F(FrameStates, FrameNShowsTheInstantNOverFramesPerSecond) {
  const Show s = show("  - {duration_s: 2, trajectory: {type: circular, r: 8, rate_m_per_s: 3}}\n",
                      "frames_per_second: 24\n");
  ASSERT_EQ(frame_count(s), 48);
  for (const int n : {0, 1, 23, 47}) {
    const FrameState f = frame_state(s, n);
    EXPECT_EQ(f.frame, n);
    EXPECT_DOUBLE_EQ(f.show_time_s, n / 24.0);
    EXPECT_NEAR(f.observer.proper_time, 3 * n / 24.0, kStateRounding);
  }
}

TEST_F(FrameStates, ASegmentBeginsWithTheFrameOfItsFirstInstant) {
  const Show s = show(
      "  - {duration_s: 1, trajectory: {type: static, r: 9}}\n"
      "  - {duration_s: 0.5, trajectory: {type: static, r: 8}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 7}}\n",
      "frames_per_second: 10\n");
  ASSERT_EQ(frame_count(s), 25);
  for (const auto& [frame, segment, r] :
       {std::tuple{0, 0, 9}, {9, 0, 9}, {10, 1, 8}, {14, 1, 8}, {15, 2, 7}, {24, 2, 7}}) {
    EXPECT_EQ(frame_state(s, frame).segment, segment) << frame;
    EXPECT_EQ(frame_state(s, frame).observer.r, r) << frame;
  }
}

TEST_F(FrameStates, AzimuthRunsOnFromSegmentToSegment) {
  const Show s = show(
      "  - {duration_s: 1, trajectory: {type: circular, r: 8, orbits: 0.4}}\n"
      "  - {duration_s: 1, trajectory: {type: static, r: 8}}\n"
      "  - {duration_s: 1, trajectory: {type: circular, r: 5, orbits: 0.25}}\n",
      "frames_per_second: 10\n");
  const auto swept = [&](int n) {
    return place_tetrad(s.hole_at, s.heading,
                        2 * std::numbers::pi *
                            (n < 10   ? 0.04 * n
                             : n < 20 ? 0.4
                                      : 0.4 + 0.025 * (n - 20)));
  };
  for (int n = 0; n < 30; ++n)
    for (int k = 0; k < 3; ++k)
      expect_close(column(frame_state(s, n).observer.sky_from_tetrad, k), column(swept(n), k));
}

// The time left goes with r^(3/2), so equal factors of one are equal factors of the other.
TEST_F(FrameStates, ASlowingFallShrinksByEqualFactorsInEqualTimes) {
  const Show s = show(
      "  - {duration_s: 4, trajectory: {type: infall, from_r: 30, to_r: 0.05, pace: slowing}}\n",
      "frames_per_second: 10\n");
  for (int n = 0; n < 40; ++n) {
    const double r = 30 * std::pow(0.05 / 30, n / 40.0);
    EXPECT_NEAR(frame_state(s, n).observer.r / r, 1, 1e-10) << n;
  }
}

TEST_F(FrameStates, AFrameDependsOnItsNumberAlone) {
  const Show s = show("  - {duration_s: 3, trajectory: {type: infall, from_r: 9, to_r: 0.1}}\n");
  const FrameState first = frame_state(s, 70);
  frame_state(s, 2);
  const FrameState again = frame_state(s, 70);
  EXPECT_EQ(first.observer.r, again.observer.r);
  EXPECT_EQ(first.observer.tetrad_from_camera, again.observer.tetrad_from_camera);
}

// ---- where the camera points ----

const char* const kMovers[] = {
    "{type: static, r: 2.5}",
    "{type: circular, r: 6}",
    "{type: circular, r: 3.2}",
    "{type: infall, from_r: 30, to_r: 0.05}",
    "{type: infall, from_r: 1.5, to_r: 0.05}",
    "{type: velocity, r: 8, speed: 0.9, direction: {radial: 1, theta: -2, phi: 0.5}}",
    "{type: velocity, r: 0.7, speed: 0.5, against: free_fall, direction: north}",
};

TEST_F(FrameStates, CameraAxesAreAlwaysARotation) {
  for (const char* mover : kMovers)
    for (const char* camera : {"look_at: hole, roll_deg: 33", "look_at: Vega, dome_tilt_deg: 20",
                               "euler_deg: [10, 200, -30], dome_tilt_deg: 5",
                               "projection: stereographic, look_at: Sirius, roll_deg: 70"}) {
      const M33d m = frame(mover, camera, 17).observer.tetrad_from_camera;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(column(m, k).length(), 1, kStateRounding);
      expect_close(column(m, 0).cross(column(m, 1)), column(m, 2));
      EXPECT_NEAR(column(m, 0).dot(column(m, 1)), 0, kStateRounding);
    }
}

TEST_F(FrameStates, TheHoleStands45DegreesAboveTheFrontOfADome) {
  for (const char* mover : kMovers) {
    const FrameState f = frame(mover, "", 12);
    expect_close(hole_seen(f.observer), at_front(f, 45 * kDegree));
    // On the image it is in the middle column, half way from the centre to the bottom edge.
    const V3d n = apply_transposed(f.observer.tetrad_from_camera, hole_seen(f.observer));
    const auto pixel = pixel_of(f.projection, {n});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->i, 4097 / 2.0, 1e-10);
    EXPECT_NEAR(pixel->j, 4097 / 2.0 + 1024, 1e-10);
  }
}

TEST_F(FrameStates, DomeTiltAddsToTheElevation) {
  const FrameState f = frame("{type: circular, r: 6}", "elevation_deg: 20, dome_tilt_deg: 15", 3);
  expect_close(hole_seen(f.observer), at_front(f, 35 * kDegree));
}

TEST_F(FrameStates, DomeTiltLiftsWhatEulerAnglesPutInFront) {
  const std::string euler = "euler_deg: [10, 60, 5], dome_tilt_deg: ";
  const FrameState level = frame("{type: circular, r: 6}", euler + "0"),
                   tilted = frame("{type: circular, r: 6}", euler + "25");
  for (const double elevation : {0.0, 0.5, 1.5})
    expect_close(at_front(level, elevation), at_front(tilted, elevation + 25 * kDegree));
}

TEST_F(FrameStates, FlatImagesHaveTheHoleInTheMiddle) {
  for (const char* mover : kMovers) {
    const FrameState f = frame(mover, "projection: stereographic, roll_deg: 40", 12);
    expect_close(hole_seen(f.observer), column(f.observer.tetrad_from_camera, 2));
  }
}

TEST_F(FrameStates, NorthOfTheOrbitIsUpWhereTheHoleIsLookedAt) {
  const FrameState f = frame("{type: static, r: 20}", "projection: stereographic");
  expect_close(column(f.observer.tetrad_from_camera, 1), V3d(0, 1, 0));  // down is Theta
  expect_close(column(f.observer.tetrad_from_camera, 0), V3d(0, 0, 1));  // Phi to the right
}

TEST_F(FrameStates, RollTurnsTheImageClockwise) {
  const FrameState f = frame("{type: static, r: 20}", "projection: stereographic, roll_deg: 90");
  // North, which was up, is now at the right edge.
  expect_close(column(f.observer.tetrad_from_camera, 0), V3d(0, -1, 0));
}

// Without rotations (X, Y, Z) are the boosted (Theta, Phi, R): [Riazuelo] sec. sec_cam.
TEST_F(FrameStates, ZeroEulerAnglesGiveThetaPhiAndR) {
  for (const char* mover : kMovers) {
    const M33d m = frame(mover, "euler_deg: [0, 0, 0]").observer.tetrad_from_camera;
    EXPECT_EQ(column(m, 0), V3d(0, 1, 0));
    EXPECT_EQ(column(m, 1), V3d(0, 0, 1));
    EXPECT_EQ(column(m, 2), V3d(1, 0, 0));
  }
}

TEST_F(FrameStates, EulerAnglesTurnAboutCThenBThenC) {
  const auto axes = [&](const char* angles) {
    return frame("{type: static, r: 9}", "euler_deg: " + std::string(angles))
        .observer.tetrad_from_camera;
  };
  const V3d r(1, 0, 0), theta(0, 1, 0), phi(0, 0, 1);
  // The rotation about C gives A' = A cos + B sin.
  expect_close(column(axes("[90, 0, 0]"), 0), phi);
  expect_close(column(axes("[90, 0, 0]"), 1), -theta);
  // Then Z leans from C towards A'.
  expect_close(column(axes("[0, 90, 0]"), 2), theta);
  expect_close(column(axes("[90, 90, 0]"), 2), phi);
  expect_close(column(axes("[0, 180, 0]"), 2), -r);
  // With no lean the first and last rotation have the same axis.
  for (int k = 0; k < 3; ++k)
    expect_close(column(axes("[50, 0, 0]"), k), column(axes("[20, 0, 30]"), k));
}

// The image is found here by the renderer's own inverse, through a table, not by the root finder
// that aims the camera; the table's azimuth is good to 1e-9.
TEST_F(FrameStates, AStarThatIsLookedAtStandsWhereItsPrimaryImageIs) {
  for (const char* mover : kMovers)
    for (const char* star : {"Sirius", "Vega"}) {
      const Show s = show("  - {duration_s: 1, trajectory: " + std::string(mover) + "}\n",
                          "camera: {elevation_deg: 60, look_at: " + std::string(star) + "}\n");
      const FrameState f = frame_state(s, 20);
      const ObserverState& o = f.observer;
      const HoleOptics optics = make_hole_optics(o.r, o.tetrad, {true, true, false});
      const V3d target = std::get<LookAtSky>(s.timeline[0].camera.attitude).target.v;
      const SkyImage image = image_of(optics.table_of(own_sky(o)),
                                      apply_transposed(o.sky_from_tetrad, target), 0, 1e-9);
      expect_close(to_observer(o.celerity, image.direction.v).direction, at_front(f, 60 * kDegree),
                   1e-8);
    }
}

TEST_F(FrameStates, InFlatSpaceAStarAtRestStandsWhereItIs) {
  const Show s = read("camera: {look_at: Betelgeuse}\ntimeline: [{duration_s: 1}]\n");
  const FrameState f = frame_state(s, 0);
  const V3d target = std::get<LookAtSky>(s.timeline[0].camera.attitude).target.v;
  expect_close(apply(f.observer.sky_from_tetrad, at_front(f, 45 * kDegree)), target);
}

// ---- the direction of motion ----

TEST_F(FrameStates, ACircularOrbitMovesAlongPhi) {
  for (const char* r : {"3.01", "6", "40"}) {
    const FrameState f = frame("{type: circular, r: " + std::string(r) + "}", "look_at: motion", 5);
    // As the orbiter sees it: Phi of the static frame, boosted along itself, is ahead.  In the
    // boosted rain tetrad that direction is found from the static observer's.
    const ObserverState& o = f.observer;
    const V3d phi_in_rain =
        to_tetrad(resting_celerity(o.r), V3d(0, 0, 1)).direction;  // light coming from static Phi
    expect_close(to_observer(o.celerity, phi_in_rain).direction, at_front(f, 45 * kDegree), 1e-12);
  }
}

TEST_F(FrameStates, AFallMovesInwardSmoothlyThroughTheHorizon) {
  const Show s =
      show("  - {duration_s: 2, trajectory: {type: infall, from_r: 2.001, to_r: 1.999}}\n",
           "camera: {look_at: motion}\n");
  int inside = 0;
  for (int n = 0; n < frame_count(s); ++n) {
    const FrameState f = frame_state(s, n);
    inside += f.observer.r < 2;
    expect_close(at_front(f, 45 * kDegree), V3d(-1, 0, 0));
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(inside, 40);
}

// With a sideways speed there is no exact direction to compare with, but it must not jump.
TEST_F(FrameStates, ASidewaysMotionTurnsSmoothlyThroughTheHorizon) {
  V3d last;
  for (int k = -50; k <= 50; ++k) {
    ObserverState o;
    o.spacetime = Schwarzschild{};
    o.r = 2 + k * 1e-4;
    o.celerity = {-0.3, 0.2, 0.7};
    const V3d now = motion_direction(o).normalized();
    if (k > -50) expect_close(now, last, 1e-4);  // the derivative by r is below 1
    last = now;
  }
}

TEST_F(FrameStates, MotionIsTheVelocityAgainstTheStaticFrame) {
  for (const double r : {2.5, 8.0, 1000.0}) {
    for (const V3d& direction : {V3d(1, 0, 0), V3d(0, 0.6, 0.8), V3d(-0.6, 0, -0.8)}) {
      ObserverState o;
      o.spacetime = Schwarzschild{};
      o.r = r;
      o.celerity = celerity_against(resting_celerity(r), Celerity<RestFrame>(direction * 0.98));
      // The static observer sees its own motion's goal at `direction`; the mover sees it dead
      // ahead.
      const V3d goal = to_tetrad(resting_celerity(r), direction).direction;
      expect_close(motion_direction(o).normalized(), to_observer(o.celerity, goal).direction,
                   1e-13);
    }
  }
}

TEST_F(FrameStates, FlyingTowardsAStarKeepsItDeadAhead) {
  for (const std::string speed : {"0.3", "0.99"}) {
    const std::string orbit =
        "  - {duration_s: 1, trajectory: {type: circular, r: 7, orbits: 0.3}}\n";
    const std::string flight =
        "  - {duration_s: 1, trajectory: {type: velocity, r: 7, direction: Vega, speed: " + speed +
        "}, camera: {look_at: ";
    const FrameState by_star = frame_state(show(orbit + flight + "Vega}}\n"), 40);
    const FrameState by_motion = frame_state(show(orbit + flight + "motion}}\n"), 40);
    for (int k = 0; k < 3; ++k)
      expect_close(column(by_star.observer.tetrad_from_camera, k),
                   column(by_motion.observer.tetrad_from_camera, k), 1e-12);
  }
}

// ---- how the sky turns ----

TEST_F(FrameStates, TurnOfTheSkyLeadsFromFrameToFrame) {
  const Show s = show(
      "  - {duration_s: 2, trajectory: {type: circular, r: 8, orbits: 0.1}}\n"
      "  - {duration_s: 2, trajectory: {type: parabolic, periastron: 6, from_r: 30, to_r: 6}}\n"
      "  - {duration_s: 2, trajectory: {type: infall, from_r: 9, to_r: 1, angular_momentum: 2}}\n");
  for (const int frame : {0, 1, 30, 59, 61, 100, 119, 130, 160}) {
    const FrameState here = frame_state(s, frame);
    // Half a frame on, in the same segment.
    const double t = here.show_time_s + 0.5 / s.frames_per_second;
    const M33d later = observer_at(s, here.segment, part_at(s, here.segment, t)).sky_from_tetrad;
    const V3d turn = here.sky_turn;
    EXPECT_GT(turn.length(), 1e-5) << frame;
    for (const V3d& d : {V3d(1, 0, 0), V3d(0, 0.6, 0.8), V3d(0.48, -0.8, 0.36)}) {
      const V3d source = apply_transposed(here.observer.sky_from_tetrad, d);
      const V3d moved = source + turn.cross(source) * 0.5;
      // What is left is of second order, or the change of the speed within the frame.
      expect_close(apply_transposed(later, d), moved, 0.1 * turn.length());
    }
  }
  // A tenth of an orbit in 60 frames, by the chord over a quarter of a frame.
  EXPECT_NEAR(frame_state(s, 20).sky_turn.length(), 0.2 * std::numbers::pi / 60, 1e-7);
}

TEST_F(FrameStates, TurnOfTheSkyIsNoneOnALineThroughTheHole) {
  const Show s = show(
      "  - {duration_s: 2, trajectory: {type: infall, from_r: 9, to_r: 1}}\n"
      "  - {duration_s: 2, trajectory: {type: static, r: 9}}\n");
  for (const int frame : {0, 30, 59, 61, 119})
    EXPECT_EQ(frame_state(s, frame).sky_turn, V3d(0, 0, 0));
}

// In doubles 0.1 + 0.1 + 0.1 exceeds 0.3, and yet the frame at the cut must not be late.
TEST(Cuts, FallOnTheirFramesHoweverTheDurationsAddUp) {
  Show show;
  show.spacetime = Schwarzschild{};
  for (int k = 0; k < 10; ++k) {
    Segment segment;
    segment.duration_s = 0.1;
    segment.trajectory = StaticObserver{10.0 + k};
    show.timeline.push_back(segment);
  }
  ASSERT_EQ(frame_count(show), 30);
  for (int frame = 0; frame < 30; ++frame) EXPECT_EQ(frame_state(show, frame).segment, frame / 3);
}

}  // namespace
}  // namespace domefall
