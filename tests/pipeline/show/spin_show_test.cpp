// Shows about a hole that spins.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/show/attitude.h"
#include "pipeline/show/body.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/state_columns.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class SpinShow : public ObservedShow {
 protected:
  Show show_with(const std::string& hole, const std::string& trajectories) {
    return read("black_hole: {mass_solar: 4e6, " + hole + "}\ntimeline:\n" + trajectories);
  }
  std::string complaint_of(const std::string& trajectory) {
    return complaint("black_hole: {mass_solar: 4e6, spin: 0.9}\ntimeline:\n" +
                     ("  - {duration_s: 2, trajectory: " + trajectory + "}\n"));
  }
  static V3d axis(const Show& s) { return axis_of(std::get<SpinningHole>(s.spacetime.kind())); }
};

TEST_F(SpinShow, TurnsAboutTheNorthOfItsOrbits) {
  const Show s = show_with(
      "spin: 0.9, at: {ra_deg: 30, dec_deg: 10}, heading_deg: 40",
      "  - {duration_s: 8, trajectory: {type: circular, r: 6, orbits: 1}}\n"
      "  - {duration_s: 8, trajectory: {type: circular, r: 6, orbits: 0.25, retrograde: true}}\n");
  const ObserverState o = at(s, 0);
  EXPECT_NEAR(polar_angle(o, std::get<SpinningHole>(s.spacetime.kind())), std::numbers::pi / 2,
              1e-14);
  EXPECT_LT((column(o.sky_from_tetrad, 0) + s.hole_at.v).length(), 1e-14);
  EXPECT_LT((column(o.sky_from_tetrad, 1) + axis(s)).length(), 1e-14);
  // After a turn, as the stars see it, the observer is back; and a quarter turn against the spin on.
  EXPECT_LT((column(at(s, 8).sky_from_tetrad, 0) + s.hole_at.v).length(), 1e-12);
  EXPECT_NEAR(column(at(s, 16).sky_from_tetrad, 0).dot(column(o.sky_from_tetrad, 2)), -1, 1e-12);
  EXPECT_NEAR(at(s, 16).azimuth, 1.5 * std::numbers::pi, 1e-12);
}

TEST_F(SpinShow, HasAnAxisOfItsOwn) {
  const Show s = show_with("spin: 0.5, charge: 0.2, axis: {ra_deg: 200, dec_deg: 60}",
                           "  - {duration_s: 8, trajectory: {type: static, r: 6, latitude_deg: 20, "
                           "dragged: true}}\n");
  EXPECT_LT((axis(s) - sky_direction(200, 60).v).length(), 1e-15);
  const ObserverState o = at(s, 4);
  EXPECT_NEAR(column(o.sky_from_tetrad, 0).dot(axis(s)), std::sin(20 * std::numbers::pi / 180),
              1e-14);
  // Who has no angular momentum is at rest, and turns with the hole.
  EXPECT_NEAR(static_celerity(o).length(), 0, 1e-14);
  EXPECT_GT(o.azimuth, 0);
  EXPECT_NEAR(o.sky_from_tetrad.determinant(), 1, 1e-14);
}

// The same gas would be 2.2316 times as hot as without a spin of 0.9.
TEST_F(SpinShow, HasADiscWhoseDefaultsFollowTheSpin) {
  const auto disc = [this](const std::string& spin, const std::string& keys) {
    return show_with(
               "spin: " + spin,
               "  - {duration_s: 1, trajectory: {type: static, r: 20}}\ndisc: {" + keys + "}\n")
        .disc.value();
  };
  const Disc usual = disc("0.9", "");
  EXPECT_NEAR(usual.t_max_k, 3000 * std::pow(2.2316, 2.0 / 3), 1);
  EXPECT_NEAR(usual.luminance, 0.0587, 1e-4);
  EXPECT_NEAR(disc("0.998", "").t_max_k / disc("0.5", "").t_max_k,
              std::pow(4.3238 / 1.3288, 2.0 / 3), 1e-3);
  EXPECT_NEAR(disc("0.9", "retrograde: true").t_max_k, 3000 * std::pow(0.7429, 2.0 / 3), 1);
  EXPECT_NEAR(disc("1e-9", "").t_max_k, 3000, 1e-3);
  EXPECT_EQ(disc("0", "").luminance, 1e-2);
  EXPECT_EQ(disc("0.9", "t_max_k: 1000").luminance, usual.luminance);
  const Disc given = disc("0.9", "t_max_k: 3000, luminance_cd_m2: 1e-2");
  EXPECT_EQ(given.t_max_k, 3000);
  EXPECT_EQ(given.luminance, 1e-2);
}

TEST_F(SpinShow, GoesOnFromSegmentToSegment) {
  const Show s =
      show_with("spin: 0.9",
                "  - {duration_s: 5, trajectory: {type: bound, periastron: 5, apoastron: 9, "
                "inclination_deg: 50}}\n"
                "  - {duration_s: 5, trajectory: {type: continue, rate_m_per_s: 20}}\n"
                "  - {duration_s: 5, trajectory: {type: infall, from_r: 4, latitude_deg: -90}}\n");
  const ObserverState a = observer_at(s, 0, 1), b = observer_at(s, 1, 0);
  EXPECT_NEAR(a.r, b.r, 1e-12);
  EXPECT_NEAR(a.azimuth, b.azimuth, 1e-12);
  EXPECT_NEAR(a.null_time, b.null_time, 1e-12);
  EXPECT_LT((a.celerity - b.celerity).length(), 1e-12);
  EXPECT_LT((column(a.sky_from_tetrad, 0) - column(b.sky_from_tetrad, 0)).length(), 1e-12);
  // Down the axis to the inner horizon, without a jump of the azimuth.
  const ObserverState end = at(s, 15);
  EXPECT_LT((column(end.sky_from_tetrad, 0) + axis(s)).length(), 1e-12);
  EXPECT_EQ(end.region, Region::kII);
  EXPECT_NEAR(end.r, 1.01 * s.spacetime.inner_horizon(), 1e-12);
  EXPECT_EQ(observer_at(s, 2, 0).proper_time, 0);
  // The motion is downwards.
  EXPECT_LT(motion_direction(at(s, 11)).x, 0);
}

TEST_F(SpinShow, HasBodiesOnItsOrbits) {
  const Show s = read(
      "black_hole: {mass_solar: 4e6, spin: 0.9, at: {ra_deg: 30, dec_deg: 10}}\n"
      "bodies:\n  circles: {r: 8, azimuth_deg: 90}\n"
      "  bound: {trajectory: {type: bound, periastron: 6, apoastron: 9, inclination_deg: 40}}\n"
      "  rests: {trajectory: {type: static, r: 5, latitude_deg: 30}}\n"
      "timeline: [{duration_s: 2, trajectory: {type: static, r: 20, latitude_deg: 30}}]\n");
  ASSERT_EQ(s.bodies.size(), 3u);
  const auto motion = [&](std::size_t k) { return motion_of(s.spacetime, s.bodies[k], M33d()); };
  // Azimuths count from the observer's first place, about the axis.
  const BodyPoint circles = motion(0).at(0);
  EXPECT_LT((circles.direction - axis(s).cross(-s.hole_at.v)).length(), 1e-12);
  EXPECT_NEAR(circles.direction.dot(circles.celerity()), circles.radial, 1e-12);
  EXPECT_GT((circles.direction.cross(circles.celerity())).dot(axis(s)), 0.28);
  EXPECT_NEAR(circles.gamma * circles.gamma - circles.celerity().length2(), 1, 1e-12);
  EXPECT_EQ(motion(0).least_r, 8);
  const BodyMotion bound = motion(1);
  double most = 0;
  for (int tau = 0; tau < 200; ++tau) {
    const BodyPoint at = bound.at(tau);
    most = std::max(most, std::abs(at.direction.dot(axis(s))));
    EXPECT_GE(at.r, 6 - 1e-9);
    EXPECT_LE(at.r, 9 + 1e-9);
  }
  EXPECT_NEAR(most, std::sin(40 * std::numbers::pi / 180), 1e-2);
  EXPECT_NEAR(motion(2).at(3).direction.dot(axis(s)), 0.5, 1e-12);
}

// Its default place is on a stable orbit.
TEST_F(SpinShow, SpotOfARetrogradeDiscIsOnAStableOrbit) {
  const Show show = read(
      "black_hole: {mass_solar: 4, spin: 0.9}\ndisc: {retrograde: true, pattern: spot}\n"
      "sky: {region_I: {background: black, stars: none}}\n"
      "timeline: [{duration_s: 1, trajectory: {type: static, r: 30}}]\n");
  EXPECT_NEAR(std::get<SpotPattern>(show.disc->patterns.at(0)).r, 8.7174, 1e-4);
}

TEST_F(SpinShow, WhatDoesNotExistIsNamed) {
  const auto has = [](const std::string& told, const char* text) {
    EXPECT_NE(told.find(text), std::string::npos) << told;
  };
  has(complaint("black_hole: {mass_solar: 4, spin: 0.9, charge: 0.8}\n"),
      "black_hole.spin must be at most 0.599998");
  // What else is said of the hole is of one that spins.
  const std::string both = complaint(
      "black_hole: {mass_solar: 4, spin: 0.5, charge: 1.2}\n"
      "timeline: [{duration_s: 1, trajectory: {type: static, r: 20, latitude_deg: 10}}]\n");
  has(both, "spin is not of a hole whose charge exceeds 1");
  EXPECT_EQ(both.find("latitude_deg"), std::string::npos) << both;
  const std::string begin = complaint(
      "black_hole: {mass_solar: 4, spin: 0.5}\n"
      "timeline: [{duration_s: 1, trajectory: {type: infall, rest_r: 6, from_r: 0, to_r: 3}}]\n");
  has(begin, "from_r must be at least 1e-6");
  EXPECT_EQ(begin.find("from_r"), begin.rfind("from_r")) << begin;
  has(complaint("black_hole: {mass_solar: 4, spin: 1}\n"), "spin must be at most 0.999999, got 1");
  has(complaint("black_hole: {mass_solar: 4, spin: -0.5}\n"),
      "spin must be at least 0, got -0.5: a hole that turns the other way has the other end");
  has(complaint("black_hole: {mass_solar: 4, axis: {ra_deg: 1, dec_deg: 2}}\n"),
      "axis is that of a hole that spins");
  has(complaint("black_hole: {mass_solar: 4, spin: 0, axis: {ra_deg: 1, dec_deg: 2}}\n"),
      "axis is that of a hole that spins; give it a spin above 0");
  for (const char* key : {"spin: 0.5", "axis: {ra_deg: 1, dec_deg: 2}"})
    has(complaint("black_hole: {mass_solar: 0, " + std::string(key) + "}\n"),
        "is of a hole, which needs a mass_solar above 0");
  has(complaint("black_hole: {spin: 0.5}\n"), "spin is of a hole, which needs mass_solar");
  has(complaint("black_hole: {mass_solar: 4, spin: 0.5}\ndisc: {inclination_deg: 3}\n"),
      "inclination_deg cannot be given: about a hole that spins gas lies in its equator");
  has(complaint("black_hole: {mass_solar: 4, spin: 0.5}\ndisc: {retrograde: true, inner_r: 7}\n"),
      "inner_r must be at least 7.5545");
  has(complaint("black_hole: {mass_solar: 4}\ndisc: {retrograde: true}\n"),
      "retrograde needs a hole that spins");
  const auto body = [&](const std::string& keys) {
    return complaint("black_hole: {mass_solar: 4, spin: 0.9}\nbodies: {a: {" + keys + "}}\n");
  };
  has(body("r: 1.5"), "must exceed 1.5578");
  has(body("r: 9, inclination_deg: 5"), "which orbits about a spin do not keep");
  has(body("elements: {}"), "an orbit about a hole without spin; give a trajectory");
  has(body("r: 3, radius: 1, rings: {inner: 1.5, outer: 3}"), "reach to 3 M from the body");
  has(body("trajectory: {type: static, r: 1.9}"), "within the ergosphere nothing rests");
  has(body("trajectory: {type: static, r: 1.5, dragged: true}, radius: 0.1"), "the horizon is at");
  has(complaint_of("{type: static, r: 9, region: III}"), "region is of holes without spin");
  has(complaint_of("{type: bound, periastron: 3, apoastron: 9, inclination_deg: 120}"),
      "periastron must be at least 6.4138");
  // What goes on from there is not another mistake.
  const std::string first = complaint(
      "black_hole: {mass_solar: 4, spin: 0.9}\ntimeline:\n"
      "  - {duration_s: 1, trajectory: {type: bound, periastron: 3, apoastron: 9, inclination_deg: "
      "120}}\n"
      "  - {duration_s: 1, trajectory: {type: continue, rate_m_per_s: 10}}\n");
  EXPECT_EQ(first.find("timeline[2]"), std::string::npos) << first;
  has(complaint_of("{type: static, r: 1.9}"),
      "must exceed 2 (units of M) at that latitude, got 1.9");
  has(complaint_of("{type: static, r: 1.4, dragged: true}"), "must exceed 1.43588989");
  has(complaint_of("{type: circular, r: 1.5}"), "must exceed 1.5578");
  has(complaint_of("{type: circular, r: 3.9, retrograde: true}"), "must exceed 3.9102");
  has(complaint_of("{type: bound, periastron: 1.7, apoastron: 9}"),
      "periastron must be at least 1.82313");
  has(complaint_of("{type: bound, periastron: 7, apoastron: 6}"), "at least the periastron, 7");
  has(complaint_of("{type: bound, periastron: 7, apoastron: 2e6}"), "apoastron must be at most");
  has(complaint_of("{type: bound, eccentricity: 0.3, semilatus_rectum: 9}"),
      "eccentricity is of an orbit about a hole without spin; about a spin give periastron, "
      "apoastron");
  has(complaint_of("{type: infall, from_r: 9, v_inf: 0.3, impact_parameter: 0}"),
      "v_inf is of a fall into a hole without spin");
  has(complaint_of("{type: infall, from_r: 9, angular_momentum: 90}"), "is too much for a fall");
  has(complaint_of("{type: infall, from_r: 20, angular_momentum: 2.7}"), "turns around at r = ");
  EXPECT_EQ(complaint_of("{type: infall, from_r: 20, angular_momentum: 2.6}"), "");
  EXPECT_EQ(complaint_of("{type: infall, from_r: 20, angular_momentum: -4.7}"), "");
  has(complaint_of("{type: infall, from_r: 20, angular_momentum: -4.8}"), "turns around at r = ");
  EXPECT_EQ(complaint_of("{type: infall, rest_r: 6, angular_momentum: 1}"), "");
  has(complaint_of("{type: infall, rest_r: 6, angular_momentum: 9}"), "turns around at r = 5.9");
  has(complaint_of("{type: infall, rest_r: 6, angular_momentum: 1, latitude_deg: 90}"),
      "must be 0 on the axis");
  for (const char* key : {"latitude_deg: 9", "inclination_deg: 9", "retrograde: true"})
    has(complaint("black_hole: {mass_solar: 4}\ntimeline:\n  - {duration_s: 2, trajectory: {type: "
                  "circular, r: 9, " +
                  std::string(key) + "}}\n"),
        "is of motion about a hole that spins; give black_hole.spin");
  has(complaint_of("{type: braked, from_r: 9, stop_r: 5}"),
      "a path whose last keyframe has speed: 0 comes to a stop about a hole that spins");
  has(complaint_of("{type: parabolic, periastron: 9}"), "leaves again is of type thrown");
  has(complaint_of("{type: circular, r: 9, latitude_deg: 5}"), "latitude_deg needs a speed");
  has(complaint_of("{type: circular, r: 9, speed: 0.5, retrograde: true}"), "a negative speed");
  has(complaint_of("{type: circular, r: 9, speed: 0.5, latitude_deg: 90}"), "is that of the axis");
  has(complaint_of("{type: velocity, r: 1.2, speed: 0}"),
      "within it speeds are 'against: free_fall'");
  has(complaint_of("{type: velocity, r: 1.8, against: static, speed: 0}"),
      "is within the ergosphere at that latitude");
  has(complaint_of(
          "{type: path, keyframes: [{at_m: 0, r: 9}, {at_m: 9, r: 1.8}, {at_m: 20, r: 1.8}]}"),
      "cannot be flown: key 1, at proper time");
  has(complaint_of("{type: path, keyframes: [{at_m: 0, r: 1.5, speed: 0.99, direction: backward}, "
                   "{at_m: 9, r: 1.5}]}"),
      "gives a negative energy there");
}

TEST_F(SpinShow, FliesWithEngines) {
  const Show s = show_with(
      "spin: 0.9",
      "  - {duration_s: 4, trajectory: {type: circular, r: 1.6, latitude_deg: 30, speed: -0.3, "
      "orbits: "
      "0.1}}\n"
      "  - {duration_s: 4, trajectory: {type: path, keyframes: [{at_m: 0, r: 9, speed: 0}, {at_m: "
      "50, r: "
      "3, latitude_deg: 60, azimuth_deg: 90, speed: 0.5, direction: forward}]}}\n"
      "  - {duration_s: 4, trajectory: {type: velocity, r: 6, latitude_deg: 60, speed: [0, 0.9], "
      "direction: Vega}}\n"
      "  - {duration_s: 4, trajectory: {type: velocity, r: 1.2, against: free_fall, speed: 0}}\n"
      "  - {duration_s: 4, trajectory: {type: thrown, from_r: 6, latitude_deg: -50, speed: 0.9, "
      "direction: Vega}}\n");
  EXPECT_NEAR(static_celerity(at(s, 2)).length(), 0.3 / std::sqrt(1 - 0.09), 1e-12);
  EXPECT_LT(static_celerity(at(s, 2)).z, 0);
  EXPECT_NEAR(static_celerity(observer_at(s, 1, 0)).length(), 0, 1e-12);
  const ObserverState end = observer_at(s, 1, 1);
  EXPECT_NEAR(static_celerity(end).z, 0.5 / std::sqrt(0.75), 1e-10);
  EXPECT_NEAR(column(end.sky_from_tetrad, 0).dot(axis(s)), std::sin(std::numbers::pi / 3), 1e-12);
  EXPECT_EQ(observer_at(s, 3, 0.5).region, Region::kII);
  // It flies to where who has no angular momentum sees Vega.
  const SkyDirection vega = sky_direction(279.235, 38.784);
  for (const int segment : {2, 4}) {
    ObserverState o = observer_at(s, segment, segment == 2 ? 1 : 0);
    const V3d ahead = static_celerity(o).normalized();
    o.celerity = resting_celerity(o);
    EXPECT_LT((ahead - target_direction(LookAtSky{vega}, o).value()).length(), 1e-9) << segment;
  }
}

// One mistake is told once.
TEST_F(SpinShow, TellsTheLatitude) {
  const auto latitude = [](const Show& s, double time) {
    return std::get<StateNumber>(state_cells(frame_state(s, nearest_frame(s, time))).back()).value;
  };
  EXPECT_EQ(kStateColumns.back(), std::string_view("latitude_deg"));
  EXPECT_NEAR(latitude(show_with("spin: 0.9, axis: {ra_deg: 3, dec_deg: 20}",
                                 "  - {duration_s: 4, trajectory: {type: static, r: 9, "
                                 "latitude_deg: -35}}\n"),
                       2),
              -35, 1e-12);
  const Show fall = show_with("spin: 0.9",
                              "  - {duration_s: 4, trajectory: {type: infall, from_r: 9, "
                              "latitude_deg: 90, to_r: 2}}\n");
  EXPECT_NEAR(latitude(fall, 3), 90, 1e-6);
  EXPECT_EQ(at(fall, 3).azimuth, 0);
  EXPECT_EQ(latitude(read("black_hole: {mass_solar: 4}\ntimeline:\n  - {duration_s: 4, trajectory: "
                          "{type: static, r: 9}}\n"),
                     2),
            0);
}

TEST_F(SpinShow, ASpinInErrorLeavesTheRestAlone) {
  for (const char* more : {"", ", charge: 0.4"}) {
    const std::string told = complaint("black_hole: {mass_solar: 4, spin: 2" + std::string(more) +
                                       "}\ntimeline:\n  - {duration_s: 2, trajectory: {type: "
                                       "circular, r: 9, retrograde: true}}\n");
    EXPECT_NE(told.find("spin must be at most 0.999999, got 2"), std::string::npos) << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  }
}

TEST_F(SpinShow, MarksThePeriastron) {
  const Show s = show_with("spin: 0.9",
                           "  - {duration_s: turn, trajectory: {type: bound, periastron: 6, "
                           "apoastron: 10, from_r: 9, rate_m_per_s: 40}}\n"
                           "  - {duration_s: 2, trajectory: {type: continue, rate_m_per_s: 20}}\n"
                           "markers: {turn: periastron}\n");
  EXPECT_NEAR(observer_at(s, 0, 1).r, 6, 1e-9);
}

}  // namespace
}  // namespace domefall
