// Tests of the bodies of show files: what their keys mean, and what is said of mistakes.
#include "pipeline/show/placement.h"
#include "tests/pipeline/show/show_keys.h"
#include "tests/pipeline/show/show_mistakes.h"

namespace domefall {
namespace {

using Bodies = ShowKeys;
using BodyMistakes = ShowMistakes;

TEST_F(Bodies, AreNoneUnlessAShowNamesThem) { EXPECT_TRUE(with("").bodies.empty()); }

TEST_F(Bodies, GoWithTheFirstOrbitFromTheObserversPlaceUnlessTheySayOtherwise) {
  const Show show = with("bodies: {beacon: {r: 10}}\n");
  ASSERT_EQ(show.bodies.size(), 1u);
  const Body& body = show.bodies[0];
  EXPECT_EQ(body.name, "beacon");
  EXPECT_EQ(body.r, 10);
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
      "bodies:\n  one: {r: 6, inclination_deg: 30, node_deg: 90, azimuth_deg: -45,"
      " temperature_k: 3e4, magnitude: -2.5}\n  two: {r: 3.5, inclination_deg: 180}\n");
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
  expect_near(show.bodies[1].normal.v, column(axes, 1));  // it goes the other way
}

TEST_F(BodyMistakes, AreToldWithTheirPlace) {
  expect_complaints({
      {"no radius", kShow + "bodies: {a: {magnitude: 1}}\n",
       "3:13: bodies.a.r is missing (units of M)"},
      {"no orbit", kShow + "bodies: {a: {r: 3}}\n",
       "3:17: bodies.a.r must exceed 3 (units of M), got 3"},
      {"a list", kShow + "bodies: [{r: 9}]\n",
       "3:9: bodies must be a map of names and bodies, e.g. {beacon: {r: 10}}, got a list"},
  });
  EXPECT_NE(
      complaint("bodies: {a: {r: 9}}\ntimeline: [{duration_s: 2, trajectory: {type: static}}]\n")
          .find("need a black hole"),
      std::string::npos);
  EXPECT_NE(complaint(kShow + "bodies: {a: {r: 9, size: 3}}\n").find("unknown key"),
            std::string::npos);
}

}  // namespace
}  // namespace domefall
