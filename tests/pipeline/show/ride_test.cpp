// Tests of observers who move as a body of their show does.
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Rides = ShowKeys;
using RideMistakes = ShowMistakes;

const std::string kBodies =
    "bodies:\n"
    "  circles: {r: 9, inclination_deg: 40, node_deg: 70, azimuth_deg: 33}\n"
    "  falls: {trajectory: {type: infall, rest_r: 9}, begins_m: 0, azimuth_deg: 20}\n"
    "  returns: {trajectory: {type: bound, periastron: 10, apoastron: 40, from_tau_m: -30}, "
    "inclination_deg: 160}\n"
    "  rises: {trajectory: {type: thrown, from_r: 5, speed: 0.7, direction: outward}, azimuth_deg: "
    "5}\n";

class RidesOn : public Rides {
 protected:
  // At three instants of the first segment the observer is where the body was `behind` before.
  static void expect_beside(const Show& show, const Body& body, double behind) {
    SCOPED_TRACE(body.name);
    const BodyMotion motion = motion_of(show.spacetime, body, M33d());
    for (const double part : {0.0, 0.4, 1.0}) {
      const ObserverState o = observer_at(show, 0, part);
      const BodyPoint at = motion.at(o.proper_time - double(body.start));
      EXPECT_NEAR(o.r, at.r, 1e-12 * at.r);
      EXPECT_LT((column(o.sky_from_tetrad, 0) - at.direction).length(), 1e-12);
      EXPECT_LT((-column(o.sky_from_tetrad, 1) - body.normal.v).length(), 1e-12);
      const double tortoise = o.r + 2 * std::log(std::abs(o.r / 2 - 1));
      const double v = o.null_time + (is_outgoing(o.tetrad) ? 2 * tortoise : 0);
      EXPECT_NEAR(v, at.null_time + behind, 1e-9);
    }
  }
};

TEST_F(RidesOn, AreWhereTheBodyIs) {
  for (std::size_t k = 0; k < 4; ++k)
    for (const double behind : {0.0, 3.0}) {
      const std::array names{"circles", "falls", "returns", "rises"};
      // Who falls behind it is not there before it has begun.
      const bool late = behind > 0 && k == 1;
      const Show show = with(kBodies, "{type: body, body: " + std::string(names[k]) +
                                          ", behind_m: " + std::to_string(behind) +
                                          (late ? ", from_r: 8.5}" : "}"));
      expect_beside(show, show.bodies[k], behind);
    }
}

// About a spin, too, whose orbits keep no plane.
TEST_F(Rides, AreWhereABodyAboutASpinIs) {
  for (const double behind : {0.0, 3.0}) {
    const Show show = read(
        "black_hole: {mass_solar: 4e6, spin: 0.9, axis: {ra_deg: 20, dec_deg: 50}}\n"
        "bodies:\n  a: {trajectory: {type: bound, periastron: 5, apoastron: 9, inclination_deg: "
        "50}, azimuth_deg: 33}\n"
        "timeline:\n  - {duration_s: 9, trajectory: {type: body, body: a, rate_m_per_s: 20, "
        "behind_m: " +
        std::to_string(behind) + "}}\n");
    const BodyMotion motion = motion_of(show.spacetime, show.bodies[0], M33d());
    for (const double part : {0.0, 0.4, 1.0}) {
      const ObserverState o = observer_at(show, 0, part);
      const BodyPoint at = motion.at(o.proper_time - double(show.bodies[0].start));
      EXPECT_NEAR(o.r, at.r, 1e-12 * at.r);
      EXPECT_LT((column(o.sky_from_tetrad, 0) - at.direction).length(), 1e-12);
      EXPECT_LT((apply(o.sky_from_tetrad, o.celerity) - at.celerity()).length(), 1e-12);
      EXPECT_NEAR(o.null_time, at.null_time + behind, 1e-9);
    }
  }
}

// The light that falls straight in reaches both observers at the cut.
TEST_F(Rides, BeginInTheLightOfTheSegmentBefore) {
  const Show show =
      read("black_hole: {mass_solar: 4e6}\n" + kBodies +
           "timeline:\n  - {duration_s: 10, trajectory: {type: static, r: 30, rate_m_per_s: 2}}\n"
           "  - {duration_s: 5, trajectory: {type: body, body: returns}}\n"
           "  - {duration_s: 5, trajectory: {type: continue, rate_m_per_s: 3}}\n"
           "  - {duration_s: 5, trajectory: {type: body, body: returns, from_tau_m: -30}}\n");
  const double v = 20 / std::sqrt(1 - 2.0 / 30);
  EXPECT_NEAR(observer_at(show, 0, 1).null_time, v, 1e-12);
  EXPECT_NEAR(observer_at(show, 1, 0).null_time, v, 1e-9);
  const ObserverState end = observer_at(show, 1, 1), on = observer_at(show, 2, 0);
  EXPECT_EQ(end.null_time, on.null_time);
  expect_near(column(end.sky_from_tetrad, 0), column(on.sky_from_tetrad, 0));
  // Back to where the body begins, at v = 0.
  EXPECT_NEAR(observer_at(show, 3, 0).null_time, 0, 1e-9);
}

TEST_F(RideMistakes, AreToldWithTheirPlace) {
  const auto with = [](const std::string& trajectory) {
    return "black_hole: {mass_solar: 10}\n" + kBodies +
           "timeline:\n  - {duration_s: 5, trajectory: {" + trajectory + "}}\n";
  };
  const auto expect_told = [this, &with](const std::string& trajectory, const std::string& what) {
    EXPECT_NE(complaint(with(trajectory)).find(what), std::string::npos)
        << complaint(with(trajectory));
  };
  expect_told("type: body", "timeline[1].trajectory.body is missing: the name of the body");
  expect_told("type: body, body: fals", "names no body of the show: 'fals'; did you mean falls?");
  expect_told("type: body, body: falls, behind_m: 3",
              "body is not there at v = -3 M, when the segment begins; give from_tau_m");
  expect_told("type: body, body: returns, from_r: 50", "is not passed");
}

}  // namespace
}  // namespace domefall
