// Orbits near a charge against what other classes and closed forms say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/trajectories/conserved.h"
#include "tests/trajectories/wide_quadrature.h"
#include "trajectories/bound_orbit.h"
#include "trajectories/charged_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {
namespace {

void expect_same(const ChargedOrbit& charged, const Geodesic& plain, double bound) {
  EXPECT_NEAR(charged.energy(), plain.energy(), bound);
  EXPECT_NEAR(charged.angular_momentum(), plain.angular_momentum(), bound);
  const double span = std::min({plain.radial_period(), 300.0, plain.death() * 0.9});
  for (const double part : {-0.3, 0.01, 0.3, 0.9}) {
    if (part * span <= plain.birth()) continue;
    const OrbitPoint a = plain.at(part * span), b = charged.at(part * span);
    EXPECT_NEAR(b.r, a.r, bound * a.r) << part;
    EXPECT_NEAR(b.azimuth, a.azimuth, bound) << part;
  }
}

TEST(ChargedOrbit, WithLittleChargeIsThatOfSchwarzschild) {
  const ChargedHole hole(1, 1e-7L);
  const double v = 0.6, excess = 0.36 / 0.64;
  expect_same(ChargedOrbit::by_periastron(hole, 7, 0), parabolic_by_periastron(7), 1e-10);
  expect_same(ChargedOrbit::scattered(hole, 0, 5), parabolic_by_angular_momentum(5), 1e-10);
  expect_same(ChargedOrbit::by_momentum_excess(hole, 0, 1e-6), parabolic_by_excess(1e-6), 1e-8);
  expect_same(ChargedOrbit::by_periastron(hole, 5, excess), hyperbolic_by_periastron(v, 5), 1e-10);
  expect_same(ChargedOrbit::scattered(hole, excess, 9 * 0.75), hyperbolic_by_impact_parameter(v, 9),
              1e-10);
  expect_same(ChargedOrbit::by_momentum_excess(hole, excess, 1e-6),
              hyperbolic_by_impact_excess(v, 1e-6), 1e-8);
  expect_same(ChargedOrbit::by_speed_excess(hole, 3.4, 1e-6), hyperbolic_by_speed_excess(3.4, 1e-6),
              1e-8);
  expect_same(ChargedOrbit::between(hole, 9, 20), bound_by_turning_points(9, 20), 1e-10);
  expect_same(ChargedOrbit::by_shape(hole, 9, 0.5), bound_by_shape(9, 0.5), 1e-10);
  expect_same(ChargedOrbit::by_shape_excess(hole, 0.5, 1e-6), bound_by_excess(0.5, 1e-6), 1e-8);
  expect_same(ChargedOrbit::from_rest(hole, 9, 2), fall_from_rest(9, 2), 1e-10);
  expect_same(ChargedOrbit::falling(hole, 9, 0, 2), fall_from_infinity(2, 9), 1e-10);
  expect_same(ChargedOrbit::falling(hole, 9, excess, 3), fall_with_speed(v, 4, 9), 1e-10);
  expect_same(ChargedOrbit::thrown(hole, 9, -0.2, 0.3), thrown_outside(9, -0.2, 0.3), 1e-10);
}

// From rest, r = A + sqrt(A^2 - q^2 A) cos eta and tau = sqrt(A) (A eta + sqrt(..) sin eta).
TEST(ChargedOrbit, RadialFallsAreCycloids) {
  for (const long double q : charges()) {
    const ChargedHole hole(1, q);
    const double q2 = hole.charge * hole.charge, r = 12;
    if (q2 > r) continue;
    const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, r, 0);
    const double e2 = hole.lapse_squared(r), a = 1 / (1 - e2), b = std::sqrt(a * a - q2 * a);
    EXPECT_NEAR(orbit.radial_period() / (2 * std::numbers::pi * std::pow(a, 1.5)), 1, 1e-13);
    for (const double eta : {0.1, 1.0, 2.5, 3.1}) {
      const double tau = std::sqrt(a) * (a * eta + b * std::sin(eta));
      EXPECT_NEAR(orbit.at(tau).r, a + b * std::cos(eta), 3e-14 * a) << double(q) << " " << eta;
    }
  }
}

TEST(ChargedOrbit, OfANakedSingularityTurnsAtHalfItsChargeSquared) {
  const ChargedHole hole(1, 1.2L);
  const ChargedOrbit rain = ChargedOrbit::falling(hole, 1e9, 0, 0);
  EXPECT_FALSE(rain.passes());
  EXPECT_NEAR(rain.innermost(), 0.72, 1e-15);
  const OrbitPoint turn = rain.at(*rain.next_periastron(0));
  EXPECT_NEAR(conserved_by(hole, turn).radial, 0, 1e-14);
  EXPECT_EQ(turn.region, Region::kI);
  EXPECT_EQ(rain.at(*rain.time_at(5, Leg::kOutward)).tetrad, Tetrad::kRain);
  // Inside of q^2 what rests is repelled.
  const ChargedOrbit away = ChargedOrbit::from_rest(hole, 0.5, 0);
  EXPECT_EQ(away.innermost(), 0.5);
  EXPECT_GT(away.at(1).r, 0.5);
  // At q^2 it stays.
  const ChargedOrbit still = ChargedOrbit::from_rest(hole, 1.44, 0);
  for (const double tau : {0.0, 1.0, 1e3}) EXPECT_NEAR(still.at(tau).r, 1.44, 1e-6);
}

TEST(ChargedOrbit, NamesWhatIsOutOfBounds) {
  const ChargedHole hole(1, 0.8L), naked(1, 1.2L);
  const auto message = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(message([&] { ChargedOrbit::from_rest(hole, 1.6, 0); }).starts_with("rest_r "));
  EXPECT_TRUE(message([&] { ChargedOrbit::from_rest(hole, 8, 9); }).starts_with("angular_mom"));
  EXPECT_TRUE(message([&] { ChargedOrbit::by_periastron(hole, 2, 0); }).starts_with("periastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::by_periastron(hole, 3, .01); }).starts_with("v_inf "));
  EXPECT_TRUE(message([&] { ChargedOrbit::between(hole, 3, 20); }).starts_with("periastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::between(hole, 9, 8); }).starts_with("apoastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::by_shape(hole, 4, 0.5); }).starts_with("p "));
  EXPECT_TRUE(message([&] { ChargedOrbit::falling(hole, 30, 0, 5); }).starts_with("angular_mom"));
  EXPECT_TRUE(message([&] { ChargedOrbit::falling(hole, 30, 1, 9); }).starts_with("impact_par"));
  EXPECT_TRUE(message([&] { ChargedOrbit::scattered(hole, 0, 2); }).starts_with("angular_mom"));
  EXPECT_TRUE(message([&] { ChargedOrbit::by_shape_excess(naked, .1, 1); }).starts_with("excess "));
  EXPECT_TRUE(message([&] { ChargedOrbit::falling(naked, 0.5, 0, 0); }).starts_with("from_r "));
  EXPECT_TRUE(message([&] { ChargedOrbit::between(naked, 0.75, 9); }).starts_with("periastron "));
}

TEST(ChargedOrbit, WithManyChargesIsBoundedWhereItsCirclesAre) {
  for (const long double q : {0.3L, 0.8L, 1 - 1e-12L, 1.0L}) {
    const ChargedHole hole(1, q);
    // The bounds of captures are circles of that energy.
    for (const double excess : {0.0, 0.5}) {
      const ChargedOrbit whirl = ChargedOrbit::by_momentum_excess(hole, excess, 1e-15);
      const double r = whirl.innermost(), time = hole.circling_time(r);
      EXPECT_NEAR(whirl.angular_momentum(), r / time, 1e-6);
      EXPECT_NEAR(whirl.energy(), std::sqrt(hole.lapse_squared(r) * (1 + 1 / (time * time))), 1e-6);
    }
    const double stable = hole.last_stable_orbit();
    EXPECT_NEAR(ChargedOrbit::by_shape_excess(hole, 0, 1e-6).innermost(), stable, 2e-3);
    EXPECT_THROW(ChargedOrbit::between(hole, stable * 0.9, stable * 0.95), std::domain_error);
  }
}

TEST(ChargedCircle, IsTheOrbitWhoseTurningPointsAreOne) {
  for (const long double q : {0.3L, 0.8L, 1.0L, 1.2L, 2.5L}) {
    const ChargedHole hole(1, q);
    const ChargedCircle circle{hole, 9};
    const ChargedOrbit ellipse = ChargedOrbit::between(hole, 9 - 1e-6, 9 + 1e-6),
                       same = ChargedOrbit::between(hole, 9, 9);
    const Conserved m = conserved_by(hole, circle.at(0));
    EXPECT_NEAR(m.energy, ellipse.energy(), 1e-10);
    EXPECT_NEAR(m.momentum, ellipse.angular_momentum(), 1e-9);
    EXPECT_NEAR(m.energy, same.energy(), 1e-14);
    EXPECT_NEAR(m.momentum, same.angular_momentum(), 1e-13);
    EXPECT_NEAR(m.radial, 0, 1e-14);
    EXPECT_NEAR(circle.at(period(circle)).azimuth, 2 * std::numbers::pi, 1e-13);
    EXPECT_NEAR(same.at(period(circle)).azimuth, 2 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(double(same.at(7).null_time - same.at(0).null_time), double(circle.at(7).null_time),
                1e-12);
  }
}

// Against E = Delta/(r sqrt D) and L^2 = r^2 (r - q^2)/D with 50 digits, next to the light circle too.
TEST(ChargedCircle, HasTheConstantsOfItsRadius) {
  for (const long double q : charges()) {
    const ChargedHole hole(1, q);
    const Digits q1 = hole.charge_long(), q2 = q1 * q1;
    const double least =
        std::max(hole.light_circle(), hole.is_naked() ? hole.charge * hole.charge : 0.0);
    for (const double above : {1e-5, 1e-3, 1.0, 1e9}) {
      const double r = least + above;
      const Digits d = Digits(r) * r - 3 * Digits(r) + 2 * q2;
      if (!(d > 0)) continue;
      const Digits energy = (Digits(r) * r - 2 * Digits(r) + q2) / (r * sqrt(d)),
                   l = r * sqrt((r - q2) / d);
      const OrbitPoint p = ChargedCircle{hole, r}.at(3);
      const Conserved m = conserved_by(hole, p);
      EXPECT_NEAR(m.momentum / static_cast<double>(l), 1, 1e-13) << double(q) << " " << r;
      EXPECT_NEAR(m.energy / static_cast<double>(energy), 1, 1e-13 * m.scale)
          << double(q) << " " << r;
      EXPECT_NEAR(m.radial, 0, 1e-14 * m.scale);
      EXPECT_NEAR(double(p.null_time) / static_cast<double>(3 * r / sqrt(d)), 1, 1e-13);
    }
  }
}

}  // namespace
}  // namespace domefall
