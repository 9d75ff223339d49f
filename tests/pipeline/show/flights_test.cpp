// Tests of segments that spiral from an orbit into a fall, and that brake to a stop.
#include <fmt/format.h>

#include <numbers>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Flights = ObservedShow;

// What an audience could see jump: the place, the velocity and, over 2e-6 of a second, little else.
void expect_no_jump(const ObserverState& a, const ObserverState& b) {
  EXPECT_NEAR(a.r, b.r, 1e-4);
  EXPECT_NEAR(a.azimuth, b.azimuth, 1e-4);
  EXPECT_NEAR(a.null_time, b.null_time, 1e-2);
  EXPECT_LT((a.celerity - b.celerity).length(), 1e-4);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a.sky_from_tetrad[k][j], b.sky_from_tetrad[k][j], 1e-4);
}

TEST_F(Flights, ASpiralGoesOnFromACircleAndIntoTheHole) {
  for (const char* from : {"12", "6", "4"}) {
    const Show s = show(fmt::format(
        "  - {{duration_s: 5, trajectory: {{type: circular, r: {0}, orbits: 0.25}}}}\n"
        "  - {{duration_s: 10, trajectory: {{type: spiral, from_r: {0}, turns: 2.5, to_r: 3}}}}\n"
        "  - {{duration_s: 5, trajectory: {{type: continue, pace: slowing, to_r: 0.05}}}}\n",
        from));
    for (const double joint : {5.0, 15.0}) expect_no_jump(at(s, joint - 1e-6), at(s, joint + 1e-6));
    EXPECT_EQ(at(s, 5).proper_time, 0);
    EXPECT_NEAR(at(s, 15).r, 3, 1e-12);
    EXPECT_NEAR(at(s, 20).r, 0.05, 1e-13);
    EXPECT_EQ(at(s, 20).region, Region::kII);
  }
}

TEST_F(Flights, ASpiralMeetsTheHorizonWhereItsTurnsSay) {
  const Show s = show("  - {duration_s: 10, trajectory: {type: spiral, from_r: 9, to_r: 2}}\n");
  EXPECT_NEAR(at(s, 10).azimuth, 6 * std::numbers::pi, 1e-11);
  EXPECT_NEAR(at(s, 10).r, 2, 1e-12);
}

TEST_F(Flights, ASpiralEndsInsideByDefaultAndInRegionThreeToo) {
  const Show s = show("  - {duration_s: 10, trajectory: {type: spiral, from_r: 9, region: III}}\n");
  EXPECT_EQ(at(s, 0).region, Region::kIII);
  EXPECT_EQ(at(s, 10).region, Region::kII);
  EXPECT_NEAR(at(s, 10).r, 0.05, 1e-13);
}

TEST_F(Flights, ABrakeGoesOnFromAFallAndHoversInTheEnd) {
  const Show s = show(
      "  - {duration_s: 5, trajectory: {type: infall, from_r: 60, to_r: 30}}\n"
      "  - {duration_s: 10, trajectory: {type: braked, from_r: 30, stop_r: 3}}\n"
      "  - {duration_s: 5, trajectory: {type: continue, rate_m_per_s: 2}}\n"
      "  - {duration_s: 5, trajectory: {type: static, r: 3}}\n");
  for (const double joint : {5.0, 15.0, 20.0})
    expect_no_jump(at(s, joint - 1e-6), at(s, joint + 1e-6));
  EXPECT_NEAR(static_celerity(at(s, 5)).x, -std::sqrt(1.0 / 14), 1e-14);
  EXPECT_EQ(at(s, 15).r, 3);
  EXPECT_NEAR(observer_at(s, 2, 1).proper_time - observer_at(s, 2, 0).proper_time, 10, 1e-11);
  EXPECT_EQ(at(s, 17).r, 3);
  EXPECT_NEAR(static_celerity(at(s, 17)).length(), 0, 1e-15);
}

// A segment that ends before the stop ends at a small speed.
TEST_F(Flights, ABrakeMayBeSeenInPart) {
  const Show s = show(
      "  - {duration_s: 5, trajectory: {type: braked, from_r: 100, stop_r: 8, speed: 0.5, to_r: "
      "10}}\n"
      "  - {duration_s: 5, trajectory: {type: continue, to_r: 8}}\n");
  EXPECT_NEAR(static_celerity(at(s, 0)).x, -0.5 / std::sqrt(0.75), 1e-14);
  EXPECT_NEAR(at(s, 5).r, 10, 1e-12);
  const double rapidity = std::atanh(0.5) * std::pow(2.0 / 92, 2.0 / 3);
  EXPECT_NEAR(static_celerity(at(s, 5)).x, -std::sinh(rapidity), 1e-12);
  EXPECT_EQ(at(s, 10).r, 8);
}

// What is left of the motion there is rounding, which once left the camera without a direction.
TEST_F(Flights, ACameraAlongTheMotionLooksAtTheHoleWhereTheyStop) {
  for (const char* stop : {"2.0001", "2.5", "3", "5", "7.3", "8", "41.7"}) {
    const Show s = show(
        fmt::format("  - {{duration_s: 5, trajectory: {{type: braked, from_r: 60, stop_r: {0}}}}}\n"
                    "  - {{duration_s: 1, trajectory: {{type: continue}}}}\n"
                    "  - {{duration_s: 2, trajectory: {{type: path, keyframes: [{{at_m: 0, r: {0}, "
                    "speed: 0}}, "
                    "{{at_m: 9, r: {0}, speed: 0}}, {{at_m: 40, r: 60, speed: 0}}]}}}}\n",
                    stop),
        "camera: {projection: rectilinear, look_at: motion}\n");
    for (const double t : {0.0, 3.0, 4.9, 5.2, 5.9, 6.1, 6.4}) {
      const int frame = nearest_frame(s, t);
      const M33d axes = frame_state(s, frame).observer.tetrad_from_camera;
      EXPECT_NEAR(axes.determinant(), 1, 1e-12) << stop << " " << t;
      EXPECT_NEAR(column(axes, 2).x, -1, 1e-9) << stop << " " << t;
    }
  }
}

}  // namespace
}  // namespace domefall
