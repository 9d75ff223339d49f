// Tests of a camera that turns from one target to the next.
#include <cmath>

#include "pipeline/light/aberration.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/frame_state.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

// This allows for a dozen roundings of numbers of size 1.
constexpr double kRounding = 1e-14;

class CameraTurns : public ShowFile {};

double camera_angle(const V3d& a, const V3d& b) { return 2 * std::asin((a - b).length() / 2); }

// The direction in which the audience sees the target, in the boosted tetrad.
V3d looked_at(const FrameState& s) {
  const M33d& m = s.observer.tetrad_from_camera;
  return (column(m, 1) + column(m, 2)) / std::sqrt(2.0);
}

TEST_F(CameraTurns, ATurnWholeLeadsToItsEndAndPartsAddUp) {
  const M33d from = from_columns({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  for (const V3d& given : {V3d(0.3, -0.2, 0.7), V3d(2, 1, -2), V3d(-0.1, 3, 0.2)}) {
    const M33d to = turned_by(from, given);
    const V3d turn = turn_between(from, to, given);
    EXPECT_LE((turn - given).length(), 10 * kRounding) << given;
    const M33d half = turned_by(from, turn / 2), whole = turned_by(half, turn / 2);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((column(whole, k) - column(to, k)).length(), 10 * kRounding) << given;
  }
}

// The camera once turned the other way round about another axis, and jumped in the end.
TEST_F(CameraTurns, OnItsWayFromTheHoleForwardTheCameraComesNearerAllTheTime) {
  const Show s = read(
      "black_hole: {mass_solar: 4e6}\nframes_per_second: 10\n"
      "timeline:\n"
      "  - duration_s: 5\n"
      "    trajectory: {type: circular, r: 6}\n"
      "    keyframes:\n"
      "      - {at_s: 0, camera: {look_at: hole}}\n"
      "      - {at_s: 4, camera: {look_at: motion}}\n");
  const ObserverState o = frame_state(s, 0).observer;
  const V3d hole = to_observer(o.celerity, V3d(-1, 0, 0)).direction;
  const V3d forward = motion_direction(o).normalized();
  const double whole = camera_angle(hole, forward);
  double before = whole + 1e-6;
  for (int n = 0; n <= 40; ++n) {
    const double left = camera_angle(looked_at(frame_state(s, n)), forward);
    EXPECT_LT(left, before + 1e-6) << n;
    before = left;
  }
  EXPECT_LT(before, 1e-6);
  const V3d middle = looked_at(frame_state(s, 20));
  EXPECT_NEAR(camera_angle(middle, hole), camera_angle(middle, forward), 1e-12);
}

// The camera once jumped to the long way round where the next segment's observer would turn the
// other way.
TEST_F(CameraTurns, AViewThatVanishesGoesOnTurningAsItsOwnObserverSees) {
  for (const char* ra : {"0", "60", "120", "180"}) {
    const Show s = read(
        std::string("black_hole: {mass_solar: 4e6}\nframes_per_second: 100\n"
                    "keyframes:\n"
                    "  - {at_s: 0, camera: {look_at: hole}}\n"
                    "  - {at_s: 4, camera: {look_at: {ra_deg: ") +
        ra +
        ", dec_deg: 10}}}\n"
        "timeline:\n"
        "  - {duration_s: 4, trajectory: {type: circular, r: 20, orbits: 0.01}}\n"
        "  - {duration_s: 4, dissolve_s: 2, trajectory: {type: circular, r: 20, orbits: 4}}\n");
    const auto axes = [&s](int n) {
      const FrameState state = frame_state(s, n);
      return (state.vanishing ? state.vanishing->observer : state.observer).tetrad_from_camera;
    };
    M33d before = axes(0);
    for (int n = 1; n < 400; ++n) {
      const M33d now = axes(n);
      for (int k = 0; k < 3; ++k)
        EXPECT_LE((column(now, k) - column(before, k)).length(), 0.05) << ra << " " << n;
      before = now;
    }
  }
}

}  // namespace
}  // namespace domefall
