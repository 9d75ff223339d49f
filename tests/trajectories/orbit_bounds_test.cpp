// Every request that no orbit fulfils, and what is said of it.
#include "trajectories/orbit_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "trajectories/bound_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/kruskal_crossing.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {
namespace {

using testing::HasSubstr;

std::string refusal(const std::function<Geodesic()>& request) {
  try {
    request();
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "accepted";
}

struct Case {
  std::string says;
  std::function<Geodesic()> request;
};

TEST(OrbitBounds, RefusalsNameTheQuantityTheBoundAndTheValue) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const std::vector<Case> cases = {
      {"periastron must exceed 4 (units of M), got 3.9: what falls",
       [] { return parabolic_by_periastron(3.9); }},
      {"periastron must exceed 4 (units of M), got nan",
       [=] { return parabolic_by_periastron(nan); }},
      {"periastron must exceed 4 (units of M), got inf",
       [=] { return parabolic_by_periastron(infinity); }},
      {"angular_momentum must exceed 4 (units of M), got 4: ",
       [] { return parabolic_by_angular_momentum(4); }},
      {"excess must be at least 1e-20", [] { return parabolic_by_excess(0); }},
      {"periastron must exceed 3 (units of M), got 3: no orbit turns there",
       [] { return hyperbolic_by_periastron(0.9, 3); }},
      {"v_inf must exceed 0.4714045208 (fraction of c), got 0.47: to turn at r = 3.5 takes more "
       "than "
       "141323.5",
       [] { return hyperbolic_by_periastron(0.47, 3.5); }},
      {"v_inf must be below", [] { return hyperbolic_by_periastron(1, 5); }},
      {"v_inf must be at least 1e-9 (fraction of c), got 0: slower is a parabolic orbit",
       [] { return hyperbolic_by_periastron(0, 5); }},
      {"periastron must be below 4", [] { return hyperbolic_by_speed_excess(4, 1e-3); }},
      {"excess must be at least 1e-20", [] { return hyperbolic_by_speed_excess(3.5, 0); }},
      {"impact_parameter must exceed 8.8", [] { return hyperbolic_by_impact_parameter(0.5, 5); }},
      {"excess must be at least 1e-20", [] { return hyperbolic_by_impact_excess(0.5, -1); }},
      {"periastron must exceed 5 (units of M), got 4.9: below it an orbit that rises to 10 falls",
       [] { return bound_by_turning_points(4.9, 10); }},
      {"apoastron must exceed 6 (units of M)", [] { return bound_by_turning_points(5, 5.9); }},
      {"apoastron must be at least 10 (units of M), got 9",
       [] { return bound_by_turning_points(10, 9); }},
      {"p must exceed 7 (units of M), got 7: at e = 0.5", [] { return bound_by_shape(7, 0.5); }},
      {"eccentricity must be below 1", [] { return bound_by_shape(9, 1); }},
      {"eccentricity must be at least 0", [] { return bound_by_shape(9, -0.1); }},
      {"excess must be at least 1e-20", [] { return bound_by_excess(0.5, 0); }},
      {"angular_momentum must be below 4 (units of M), got 4: what falls from rest at infinity "
       "with "
       "more comes back",
       [] { return fall_from_infinity(4, 10); }},
      {"angular_momentum must be at least 0", [] { return fall_from_infinity(-1, 10); }},
      {"start_r must exceed 0 (units of M), got 0", [] { return fall_from_infinity(1, 0); }},
      {"impact_parameter must be below 8.8", [] { return fall_with_speed(0.5, 9, 10); }},
      {"start_r must exceed 2 (units of M), got 2: nothing rests",
       [] { return fall_from_rest(2, 0); }},
      {"angular_momentum must be below 3.535533906 (units of M), got 4: with more, what starts at "
       "r "
       "= 10 does not fall in",
       [] { return fall_from_rest(10, 4); }},
      {"r must exceed 2 (units of M)", [] { return thrown_outside(2, 0, 0); }},
      {"radial celerity must be a finite number", [=] { return thrown_outside(9, infinity, 0); }},
      {"tangential celerity must be at least 0 (gamma v), got -1",
       [] { return thrown_outside(9, 0, -1); }},
      {"r must exceed 0 (units of M)", [] { return thrown_from_rain(-1, 0, 0); }},
      {"radial celerity must be a finite number", [=] { return thrown_from_rain(1, nan, 0); }},
      {"below 1e15", [] { return thrown_outside(9, 1e16, 0); }},
      {"below 1e15", [] { return thrown_outside(9, 1e200, 0); }},
      {"start between r = 1e-16 and 1e30", [] { return thrown_outside(1e31, -1, 0); }},
      {"start between r = 1e-16 and 1e30", [] { return thrown_from_rain(1e-17, -1, 0); }},
      {"below 1e15", [] { return parabolic_by_periastron(1e40); }},
      {"below 1e15", [] { return kruskal_crossing(0, 1e200); }},
      {"below 1e15", [] { return fall_from_rest(2.5, 1e200); }},
      {"energy must be at least 0", [] { return kruskal_crossing(-1); }},
      {"energy must be at least 1e-6", [] { return kruskal_crossing(1e-7); }},
      {"angular_momentum must be at least 0", [] { return kruskal_crossing(1, -1); }},
  };
  for (const Case& c : cases) {
    const std::string text = refusal(c.request);
    EXPECT_THAT(text, HasSubstr(c.says));
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

// [Riazuelo] figs. fighy1 and fighy2.
TEST(OrbitBounds, TheSlowestSpeedsAreThePapers) {
  EXPECT_NEAR(slowest_speed_at_infinity(3.5), std::sqrt(2.0) / 3, 1e-15);
  EXPECT_NEAR(slowest_speed_at_infinity(3.5) * kLightSpeedKmPerS, 141323, 1);
  EXPECT_NEAR(slowest_speed_at_infinity(3.1) * kLightSpeedKmPerS, 258552, 1);
  for (const double r : {3.1, 3.5, 3.9}) {
    const double e = (6 - r) / (r - 2);
    EXPECT_NEAR(slowest_speed_at_infinity(r), std::sqrt((e * e - 1) / 8), 1e-15);
  }
}

// Of light 3 sqrt 3; slowly 4/v.
TEST(OrbitBounds, CaptureHasItsTwoLimits) {
  EXPECT_NEAR(capture_impact_parameter(1 - 1e-12), 3 * std::sqrt(3.0), 1e-10);
  EXPECT_NEAR(capture_impact_parameter(1e-6) * 1e-6, 4, 1e-10);
}

// On both sides of a bound, as near as doubles go, an orbit does what the bound says.
TEST(OrbitBounds, AreSharp) {
  const double v = 0.5, b = capture_impact_parameter(v);
  EXPECT_GT(hyperbolic_by_impact_parameter(v, b * (1 + 1e-13)).innermost(), 3);
  EXPECT_EQ(fall_with_speed(v, b * (1 - 1e-13), 30).innermost(), 0);
  EXPECT_EQ(parabolic_by_angular_momentum(4 + 1e-15).death(),
            std::numeric_limits<double>::infinity());
  EXPECT_GT(fall_from_infinity(4 - 1e-15, 30).death(), 100);
  for (const double r : {3.5, 5.0, 6.0, 7.0, 100.0, 1e6}) {
    EXPECT_GT(fall_from_rest(r, fall_bound(r) * (1 - 1e-13)).death(), 30);
    EXPECT_GT(thrown_outside(r, 0, fall_bound(r) * (1 + 1e-9) / r).innermost(), 3);
  }
  EXPECT_TRUE(std::isinf(fall_bound(2.5)));
}

}  // namespace
}  // namespace domefall
