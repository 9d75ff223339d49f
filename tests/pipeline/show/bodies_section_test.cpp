// Tests of the bodies of show files: what their keys mean, and what is said of mistakes.
#include "pipeline/show/placement.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using Bodies = ShowKeys;
using BodyMistakes = ShowMistakes;

const std::string kOrbit =
    "{period_years: 16, eccentricity: 0.9, inclination_deg: 1, node_deg: 2, pericentre_deg: 3, "
    "pericentre_year: 4}";

TEST_F(Bodies, AreNoneUnlessAShowNamesThem) { EXPECT_TRUE(with("").bodies.empty()); }

TEST_F(Bodies, GoWithTheFirstOrbitFromTheObserversPlaceUnlessTheySayOtherwise) {
  const Show show = with("bodies: {beacon: {r: 10}}\n");
  ASSERT_EQ(show.bodies.size(), 1u);
  const Body& body = show.bodies[0];
  EXPECT_EQ(body.name, "beacon");
  EXPECT_EQ(std::get<CircularOrbit>(body.trajectory).r, 10);
  EXPECT_EQ(body.azimuth, 0);
  EXPECT_EQ(body.temperature, 6000);
  EXPECT_EQ(body.magnitude, 0);
  const M33d axes = place_tetrad(show.hole_at, show.heading, 0);
  expect_near(body.node.v, column(axes, 0));
  expect_near(body.normal.v, -column(axes, 1));
  expect_near(body.normal.v.cross(body.node.v), column(axes, 2));  // onward, with the observer
}

TEST_F(Bodies, RiseAtTheirNodeByTheirInclination) {
  const Show show = with(
      "bodies:\n  one: {r: 6, inclination_deg: 30, node_deg: 90, azimuth_deg: -45, temperature_k: "
      "3e4, magnitude: -2.5, radius: 0.2}\n  two: {r: 3.5, inclination_deg: 180}\n");
  ASSERT_EQ(show.bodies.size(), 2u);
  const Body& one = show.bodies[0];
  const M33d axes = place_tetrad(show.hole_at, show.heading, 0);
  expect_near(one.node.v, column(axes, 2));
  EXPECT_NEAR(one.normal.v.dot(-column(axes, 1)), std::cos(30 * kDegree), 1e-14);
  EXPECT_NEAR(one.normal.v.dot(one.node.v), 0, 1e-14);
  // A quarter of a turn after the node it is to the north of the plane.
  EXPECT_NEAR(one.normal.v.cross(one.node.v).dot(-column(axes, 1)), std::sin(30 * kDegree), 1e-14);
  EXPECT_NEAR(one.azimuth, -45 * kDegree, 1e-15);
  EXPECT_EQ(one.temperature, 3e4);
  EXPECT_EQ(one.magnitude, -2.5);
  EXPECT_EQ(one.radius, 0.2);
  EXPECT_EQ(show.bodies[1].radius, 0);
  expect_near(show.bodies[1].normal.v, column(axes, 1));  // it goes the other way
}

TEST_F(Bodies, AreLitFromThePlaceThatTheyName) {
  const Show show = with(
      "bodies:\n  moon: {r: 30, radius: 1, lit_from: sun}\n  sun: {r: 60, radius: 2}\n"
      "  dust: {r: 90, radius: 1, lit_from: disc}\n"
      "  rock: {r: 99, radius: 1, lit_from: {ra_deg: 0, dec_deg: 90}}\n");
  ASSERT_EQ(show.bodies.size(), 4u);
  const auto& lamp = std::get<std::shared_ptr<const Body>>(*show.bodies[0].lit_from);
  EXPECT_EQ(lamp->name, "sun");
  EXPECT_EQ(std::get<CircularOrbit>(lamp->trajectory).r, 60);
  EXPECT_FALSE(show.bodies[1].lit_from);
  EXPECT_TRUE(std::holds_alternative<LitFromHole>(*show.bodies[2].lit_from));
  expect_near(std::get<SkyDirection>(*show.bodies[3].lit_from).v, V3d(0, 0, 1));
}

TEST_F(Bodies, DoNotLightEachOther) {
  const std::string told = complaint(
      "bodies:\n  a: {r: 30, radius: 1, lit_from: b}\n  b: {r: 60, radius: 2, lit_from: a}\n");
  for (const char* body : {"bodies.a is lit from 'b'", "bodies.b is lit from 'a'"})
    EXPECT_NE(told.find(body), std::string::npos) << told;
}

TEST_F(Bodies, HaveGranulesAndRings) {
  const Show show = with(
      "bodies:\n  sun: {r: 60, radius: 2}\n  hot: {r: 60, radius: 2, temperature_k: 20000}\n"
      "  even: {r: 60, radius: 2, granulation: 0}\n"
      "  planet: {r: 90, radius: 1, lit_from: sun, tilt_deg: 20, rings: [{inner: 1.2, outer: 1.5, "
      "opacity: 0.1}, {inner: 1.5, outer: 2, colour: [1, 0.5, 0.2]}]}\n");
  ASSERT_EQ(show.bodies.size(), 4u);
  EXPECT_EQ(show.bodies[0].granulation, 0.12);
  for (const std::size_t k : {1, 2, 3}) EXPECT_EQ(show.bodies[k].granulation, 0) << k;
  const Body& planet = show.bodies[3];
  ASSERT_EQ(planet.rings.size(), 2u);
  EXPECT_EQ(planet.rings[0].inner, 1.2);
  EXPECT_EQ(planet.rings[0].outer, 1.5);
  EXPECT_EQ(planet.rings[0].opacity, 0.1);
  EXPECT_EQ(planet.rings[1].opacity, 0.7);
  EXPECT_GT(planet.rings[1].colour.r, 2 * planet.rings[1].colour.b);
  EXPECT_TRUE(show.bodies[0].rings.empty());
  // Its north leans towards the node.
  const M33d axes = own_axes(planet);
  EXPECT_NEAR(column(axes, 2).dot(planet.normal.v), std::cos(20 * kDegree), 1e-14);
  EXPECT_NEAR(column(axes, 2).dot(planet.node.v), std::sin(20 * kDegree), 1e-14);
  EXPECT_NEAR(column(axes, 0).dot(column(axes, 2)), 0, 1e-14);
  expect_near(column(axes, 2).cross(column(axes, 0)), column(axes, 1));
}

TEST_F(Bodies, GoTheirOwnWays) {
  const Show show = with(
      "bodies:\n  falls: {trajectory: {type: infall, rest_r: 9}, begins_m: 3, azimuth_deg: 20}\n"
      "  passes: {trajectory: {type: hyperbolic, v_inf: 0.3, periastron: 12, from_r: 100}}\n"
      "camera: {look_at: {body: falls}}\n");
  ASSERT_EQ(show.bodies.size(), 2u);
  const M33d axes = place_tetrad(show.hole_at, show.heading, 0);
  const BodyMotion falls = motion_of(show.spacetime, show.bodies[0], axes),
                   passes = motion_of(show.spacetime, show.bodies[1], axes);
  EXPECT_EQ(falls.begin, 0);
  const BodyPoint start = falls.at(1e-6);
  EXPECT_NEAR(start.r, 9, 1e-9);
  EXPECT_NEAR(start.null_time, 3, 1e-5);
  EXPECT_NEAR(start.direction.x, std::cos(20 * kDegree), 1e-9);
  EXPECT_NEAR(start.direction.z, std::sin(20 * kDegree), 1e-9);
  EXPECT_LT(falls.at(0.999 * falls.end).r, 2);
  EXPECT_NEAR(passes.at(0).r, 100, 1e-9);
  EXPECT_EQ(passes.begin, -HUGE_VAL);
  EXPECT_GT(passes.at(-100).r, 100);
  const auto* target = std::get_if<LookAtBody>(&show.timeline[0].camera.attitude);
  ASSERT_TRUE(target);
  EXPECT_EQ(target->body->name, "falls");
}

TEST_F(Bodies, InAWormholeMoveOnBothSides) {
  const Show show = read(
      "wormhole: {radius_km: 1}\n"
      "bodies:\n  rests: {trajectory: {type: static, l: -3}}\n"
      "  flies: {trajectory: {type: infall, from_l: 2, speed: 0.5}}\n"
      "timeline: [{duration_s: 2, trajectory: {type: static, l: 9}}]\n");
  ASSERT_EQ(show.bodies.size(), 2u);
  const BodyMotion rests = motion_of(show.spacetime, show.bodies[0], M33d()),
                   flies = motion_of(show.spacetime, show.bodies[1], M33d());
  EXPECT_EQ(rests.at(5).l, -3);
  EXPECT_EQ(rests.at(5).null_time, 5 - 3 + 3);  // v = t + l is 0 where it begins
  // gamma dl/dt = -0.577 a radius of the throat's light time.
  EXPECT_NEAR(flies.at(6).l, 2 - 6 * 0.5 / std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(flies.at(6).radial, -0.5 / std::sqrt(0.75), 1e-12);
}

TEST_F(Bodies, NearAChargeEndAtTheInnerHorizon) {
  const Show show = with(
      "begins_year: 2010\nbodies:\n  circles: {r: 2.7}\n"
      "  falls: {trajectory: {type: infall, rest_r: 9}}\n  rests: {trajectory: {type: static, r: "
      "5}}\n"
      "  orbits: {elements: " +
          kOrbit + "}\n",
      "{type: static, r: 9}", "{mass_solar: 4e6, charge: 0.9}");
  ASSERT_EQ(show.bodies.size(), 4u);
  const ChargedHole hole = std::get<ChargedHole>(show.spacetime.kind());
  EXPECT_EQ(std::get<ChargedCircle>(show.bodies[0].trajectory).r, 2.7);
  const BodyMotion falls = motion_of(show.spacetime, show.bodies[1], M33d());
  EXPECT_NEAR(falls.at(1e-6).r, 9, 1e-9);
  EXPECT_NEAR(falls.at(falls.end * (1 - 1e-9)).r, hole.inner_horizon(), 1e-6);
  EXPECT_GT(falls.at(falls.end * (1 - 1e-9)).r, hole.inner_horizon());
  // It has risen from the past horizon, and from a universe before.
  EXPECT_NEAR(falls.at(-1e-3).r, 9, 1e-3);
  EXPECT_EQ(falls.at(-falls.end * 1.01).r, 0);
  EXPECT_EQ(motion_of(show.spacetime, show.bodies[2], M33d()).at(77).r, 5);
  // By Kepler's third law it has a semimajor axis of (16 years/2 pi)^(2/3).
  const double years = 16 * 31557600 / show.spacetime.seconds_per_m();
  const double axis = std::pow(years / (2 * std::numbers::pi), 2.0 / 3);
  EXPECT_NEAR(motion_of(show.spacetime, show.bodies[3], M33d()).at(0).r, axis * 0.1, 1e-6 * axis);
}

// S2 by the GRAVITY Collaboration (2019, A&A 625, L10): it came towards its pericentre of May 2018
// receding at 4000 km/s, and went from it approaching at 1900 km/s.
TEST_F(Bodies, HaveTheOrbitsThatAstronomersPublish) {
  const Show show = with(
      "begins_year: 2010\nbodies: {S2: {elements: {period_years: 16.05, eccentricity: 0.8843, "
      "inclination_deg: 133.9, node_deg: 228.07, pericentre_deg: 66.25, pericentre_year: 2018.38}, "
      "absolute_magnitude: -3.8}}\n",
      "{type: infall, from_r: 30}", "{mass_solar: 4.154e6}");
  ASSERT_EQ(show.bodies.size(), 1u);
  const double seconds = show.spacetime.seconds_per_m(), year = 31557600 / seconds;
  EXPECT_NEAR(show.bodies[0].null_time, 8.38 * year, 1e-6 * year);
  // At 10 pc, 1.0293e9 light seconds, it would be of magnitude -3.8.
  EXPECT_NEAR(show.bodies[0].magnitude, -3.8 - 5 * std::log10(1.0293e9 / (100 * seconds)), 1e-3);
  const BodyMotion motion = motion_of(show.spacetime, show.bodies[0], M33d());
  const V3d away = show.hole_at.v, east = V3d(-away.y, away.x, 0).normalized(),
            north = away.cross(east);
  const auto place = [&motion](double tau) {
    const BodyPoint point = motion.at(tau);
    return point.direction * point.r;
  };
  double most = 0, least = 0, nearest = 1;  // to the node, as a part of r
  V3d at_node(0, 0, 0);
  for (int day = -1000; day <= 1000; ++day) {
    const double tau = day * year / 365.25, step = 0.1 * year / 365.25;
    const double velocity =
        299792.458 * (place(tau + step) - place(tau - step)).dot(away) / (2 * step);
    most = std::max(most, velocity);
    least = std::min(least, velocity);
    const V3d at = place(tau).normalized();
    if (velocity < 0 || std::abs(at.dot(away)) > nearest) continue;
    nearest = std::abs(at.dot(away));
    at_node = at;
  }
  EXPECT_NEAR(most, 3972, 12);
  EXPECT_NEAR(least, -1886, 6);
  EXPECT_NEAR(std::atan2(at_node.dot(east), at_node.dot(north)), (228.07 - 360) * kDegree, 0.05);
  // 0.12506'' of 8178 pc are 1022.7 AU, of 499.0 light seconds each.
  EXPECT_NEAR(motion.at(0).r * seconds, 1022.7 * 499.0 * (1 - 0.8843), 0.3 * 499.0);
  EXPECT_NEAR(place(0).normalized().dot(away),
              std::sin(66.25 * kDegree) * std::sin(133.9 * kDegree), 1e-12);
}

TEST_F(BodyMistakes, AreToldWithTheirPlace) {
  expect_complaints_of_lines({
      {"bodies: {a: {magnitude: 1}}",
       "3:13: bodies.a.trajectory is missing: how the body moves, or r, the radius of its circular "
       "orbit, or elements"},
      {"bodies: {a: {trajectory: {type: path, file: x.csv}}}",
       "3:33: bodies.a.trajectory.type must be static, circular, parabolic, hyperbolic, bound, "
       "infall or thrown, got 'path'"},
      {"bodies: {a: {trajectory: {type: infall, from_r: 9, to_r: 3}}}",
       "3:58: bodies.a.trajectory.to_r is for the trajectories of segments"},
      {"begins_year: 1\nbodies: {a: {elements: {period_years: 1e-12, eccentricity: 0.5, "
       "inclination_deg: 1, node_deg: 2, pericentre_deg: 3, pericentre_year: 4}}}",
       "4:24: bodies.a.elements has an orbit that this hole does not have: p must exceed 7 (units "
       "of M), got 0.7598204518: at e = 0.5 a smaller orbit falls into the hole (p > 6 + 2e)"},
      {"bodies: {a: {r: 9}}\ncamera: {look_at: {body: b}}",
       "4:26: camera.look_at.body names no body of the show: 'b'"},
      {"bodies: {a: {r: 3}}", "3:17: bodies.a.r must exceed 3 (units of M), got 3"},
      {"bodies: {a: {r: 9, radius: 0}}", "3:28: bodies.a.radius must exceed 0 (units of M), got 0"},
      {"bodies: {a: {r: 9, lit_from: disc}}",
       "3:30: bodies.a.lit_from is for a sphere, which has a radius"},
      {"bodies: {a: {r: 9, radius: 1, lit_from: a}}",
       "3:41: bodies.a.lit_from must be another body"},
      {"bodies: {a: {r: 9, granulation: 0.1}}",
       "3:33: bodies.a.granulation is for a sphere, which has a radius"},
      {"bodies: {a: {r: 9, radius: 1, lit_from: disc, granulation: 0.1}}",
       "3:60: bodies.a.granulation is for the surface of a star, which has no texture and shines "
       "itself"},
      {"bodies: {a: {r: 9, rings: {inner: 2, outer: 3}}}",
       "3:27: bodies.a.rings is for a sphere, which has a radius"},
      {"bodies: {a: {r: 9, radius: 1, rings: {inner: 2}}}",
       "3:38: bodies.a.rings.outer is missing (of the body's radii)"},
      {"bodies: {a: {r: 9, radius: 1, rings: {inner: 2, outer: 1.5}}}",
       "3:56: bodies.a.rings.outer must exceed inner = 2, got 1.5"},
      {"bodies: {a: {r: 9, radius: 1, rings: [{inner: 1.2, outer: 2}, {inner: 1.5, outer: 3}]}}",
       "3:71: bodies.a.rings[2].inner must not be below the outer = 2 of the ring before it, got "
       "1.5"},
      {"bodies: {a: {r: 9, radius: 1, rings: {inner: 0.5, outer: 1.5}}}",
       "3:46: bodies.a.rings.inner must be at least 1 (of the body's radii), got 0.5"},
      {"bodies: {a: {r: 9, radius: 3, rings: {inner: 1.5, outer: 3}}}",
       "3:38: bodies.a.rings reach to 9 M from the body, which must stay below 7: the horizon"},
      {"bodies: [{r: 9}]",
       "3:9: bodies must be a map of names and bodies, e.g. {beacon: {r: 10}}, got a list"},
  });
  expect_complaints({
      {kShow + "begins_year: 1\nbodies: {a: {r: 9, elements: " + kOrbit + "}}\n",
       "4:17: bodies.a.r excludes elements; give one of them"},
      {kShow + "bodies: {a: {elements: " + kOrbit + "}}\n",
       "3:131: bodies.a.elements.pericentre_year needs the show's begins_year, the year in which "
       "it begins"},
  });
  EXPECT_NE(
      complaint("bodies: {a: {r: 9}}\ntimeline: [{duration_s: 2, trajectory: {type: static}}]\n")
          .find("need a black hole"),
      std::string::npos);
  expect_complaints(
      {{"black_hole: {mass_solar: 1, charge: 1}\n"
        "timeline: [{duration_s: 2, trajectory: {type: static, r: 9}}]\nbodies: {a: {r: 2}}\n",
        "3:17: bodies.a.r must exceed 2 (units of M), got 2"},
       {"wormhole: {radius_km: 1}\ntimeline: [{duration_s: 2, trajectory: {type: static, l: 9}}]\n"
        "bodies: {a: {r: 9}}\n",
        "3:17: bodies.a.r is a circular orbit about a hole; in a wormhole give a trajectory"},
       {"wormhole: {radius_km: 1}\nbegins_year: 1\n"
        "timeline: [{duration_s: 2, trajectory: {type: static, l: 9}}]\n"
        "bodies: {a: {elements: " +
            kOrbit + "}}\n",
        "4:24: bodies.a.elements is an orbit about a hole; in a wormhole give a trajectory"}});
  // Once.
  const std::string unknown = complaint(kShow + "bodies: {a: {r: 9, size: 3}}\n");
  EXPECT_NE(unknown.find("unknown key"), std::string::npos);
  EXPECT_EQ(unknown.find("unknown key"), unknown.rfind("unknown key"));
}

}  // namespace
}  // namespace domefall
