#include "trajectories/charged_orbit.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "trajectories/geodesic.h"
#include "trajectories/infall.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {
namespace {

struct Conserved {
  double energy, radial, momentum;
};

// What a state says by the components of d/dt along T and R.
Conserved conserved_by(const ChargedHole& hole, const OrbitPoint& p) {
  const StaticTime time = hole.static_time(p.r);
  const double along_r = is_outgoing(p.tetrad) ? -time.along_r : time.along_r;
  const double gamma = std::sqrt(1 + p.celerity.length2());
  return {time.along_t * gamma - along_r * p.celerity.x,
          time.along_t * p.celerity.x - along_r * gamma, p.r * p.celerity.z};
}

struct Case {
  const char* name;
  ChargedHole hole;
  ChargedOrbit orbit;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const long double q : {0.1L, 0.5L, 0.8L, 0.99L, 1.0L}) {
    const ChargedHole hole(1, q);
    all.push_back({"rain", hole, ChargedOrbit::through(hole, 30, 0, 0)});
    all.push_back({"fall with L", hole, ChargedOrbit::through(hole, 30, 0, 2)});
    all.push_back({"fast fall", hole, ChargedOrbit::through(hole, 30, 3, 1)});
    all.push_back({"from rest", hole, ChargedOrbit::from_rest(hole, 10, 1.5)});
    all.push_back({"from rest, radial", hole, ChargedOrbit::from_rest(hole, 6, 0)});
    all.push_back({"parabola", hole, ChargedOrbit::by_periastron(hole, 7, 0)});
    all.push_back({"hyperbola", hole, ChargedOrbit::by_periastron(hole, 5, 1.5)});
    all.push_back({"ellipse", hole, ChargedOrbit::between(hole, 9, 20)});
  }
  return all;
}

TEST(ChargedOrbit, KeepsItsEnergyAndAngularMomentum) {
  for (const Case& c : cases())
    for (const double share : {-0.49, -0.1, -1e-3, 1e-3, 0.2, 0.45}) {
      const double span = std::min(c.orbit.radial_period(), 200.0);
      const OrbitPoint p = c.orbit.at(share * span);
      const Conserved m = conserved_by(c.hole, p);
      const double size = std::sqrt(1 + p.celerity.length2());
      EXPECT_NEAR(m.energy, c.orbit.energy(), 3e-12 * size * size) << c.name << " " << p.r;
      EXPECT_NEAR(m.momentum, c.orbit.angular_momentum(), 1e-13 * (1 + p.r)) << c.name;
      EXPECT_EQ(m.radial > 0, share > 0) << c.name << " " << p.r;
    }
}

// r'' = -d/dr (f (1 + L^2/r^2))/2, phi' = L/r^2, which is regular everywhere.
using State = std::array<double, 3>;

TEST(ChargedOrbit, FollowsTheGeodesicEquation) {
  namespace odeint = boost::numeric::odeint;
  for (const Case& c : cases()) {
    // A small charge turns an orbit so near to the middle that the integrator is lost there.
    if (c.hole.charge < 0.4) continue;
    const double q2 = c.hole.charge * c.hole.charge, l2 = std::pow(c.orbit.angular_momentum(), 2);
    const auto equations = [&](const State& x, State& rate, double) {
      const double w = 1 / x[0];
      rate[0] = x[1];
      rate[1] = w * w * ((-1 + (q2 + l2) * w) + l2 * w * w * (-3 + 2 * q2 * w));
      rate[2] = c.orbit.angular_momentum() * w * w;
    };
    const double span = std::min(0.9 * c.orbit.radial_period(), 100.0);
    const OrbitPoint from = c.orbit.at(-span / 2), to = c.orbit.at(span / 3);
    State x{from.r, conserved_by(c.hole, from).radial, from.azimuth};
    odeint::integrate_adaptive(
        odeint::make_controlled(1e-14, 1e-13, odeint::runge_kutta_fehlberg78<State>()), equations,
        x, -span / 2, span / 3, 1e-3);
    EXPECT_NEAR(x[0], to.r, 2e-9 * to.r) << c.name << " q " << c.hole.charge;
    EXPECT_NEAR(x[2], to.azimuth, 2e-9) << c.name << " q " << c.hole.charge;
  }
}

TEST(ChargedOrbit, PassesTheHorizonsInTheirOrder) {
  const ChargedHole hole(1, 0.8L);
  const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, 10, 0);
  ASSERT_TRUE(orbit.passes());
  // Outside a hole of charge 0.8 horizons are at 1.6 and 0.4.
  const auto region = [&](double r, Leg leg) {
    return orbit.at(*orbit.time_at(r, leg, -orbit.radial_period() / 2));
  };
  EXPECT_EQ(region(5, Leg::kInward).region, Region::kI);
  EXPECT_EQ(region(1, Leg::kInward).region, Region::kII);
  EXPECT_EQ(region(0.39, Leg::kInward).region, Region::kV);
  EXPECT_EQ(region(0.39, Leg::kOutward).region, Region::kV);
  EXPECT_EQ(region(1, Leg::kOutward).region, Region::kIV);
  EXPECT_EQ(region(1, Leg::kOutward).universe, 1);
  EXPECT_EQ(region(5, Leg::kOutward).region, Region::kI);
  const OrbitPoint again = orbit.at(orbit.radial_period() + 1e-3);
  EXPECT_EQ(again.universe, 1);
  EXPECT_EQ(again.region, Region::kV);
  // The charge turns it at q^2/r_a-ish: the product of both turning points of a radial fall is
  // q^2/(1 - E^2).
  const double below = (1 - orbit.energy()) * (1 + orbit.energy());
  EXPECT_NEAR(orbit.innermost() * 10, 0.64 / below, 1e-12);
}

// Null times join where the tetrad changes, at the periastron and far away: v - u = 2 r*.
TEST(ChargedOrbit, HasNullTimesOfOneT) {
  const ChargedHole hole(1, 0.8L);
  const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, 10, 0.5);
  const double step = 1e-9;
  const OrbitPoint before = orbit.at(-step), after = orbit.at(step);
  EXPECT_NEAR(double(before.null_time - after.null_time), 2 * hole.tortoise(orbit.innermost()),
              1e-7);
  const double half = orbit.radial_period() / 2;
  const OrbitPoint out = orbit.at(half - step), in = orbit.at(half + step);
  EXPECT_NEAR(double(in.null_time - out.null_time), 2 * hole.tortoise(10), 1e-7);
}

TEST(ChargedOrbit, WithLittleChargeIsThatOfSchwarzschild) {
  const ChargedHole hole(1, 1e-7L);
  const Geodesic parabola = parabolic_by_periastron(7);
  const ChargedOrbit charged = ChargedOrbit::by_periastron(hole, 7, 0);
  for (const double tau : {-300.0, -20.0, 15.0, 250.0}) {
    const OrbitPoint a = parabola.at(tau), b = charged.at(tau);
    EXPECT_NEAR(b.r, a.r, 1e-10 * a.r) << tau;
    EXPECT_NEAR(b.azimuth, a.azimuth, 1e-10) << tau;
  }
}

TEST(ChargedOrbit, NamesWhatIsOutOfBounds) {
  const ChargedHole hole(1, 0.8L);
  const auto message = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(message([&] { ChargedOrbit::from_rest(hole, 1.6, 0); }).starts_with("rest_r "));
  EXPECT_TRUE(message([&] { ChargedOrbit::by_periastron(hole, 2, 0); }).starts_with("periastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::between(hole, 3, 20); }).starts_with("periastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::between(hole, 9, 8); }).starts_with("apoastron "));
  EXPECT_TRUE(message([&] { ChargedOrbit::through(hole, 3, 0, 50); }).starts_with("r "));
}

TEST(ChargedCircle, IsTheOrbitWhoseTurningPointsAreOne) {
  for (const long double q : {0.3L, 0.8L, 1.0L}) {
    const ChargedHole hole(1, q);
    const ChargedCircle circle{hole, 9};
    const ChargedOrbit ellipse = ChargedOrbit::between(hole, 9 - 1e-6, 9 + 1e-6);
    const Conserved m = conserved_by(hole, circle.at(0));
    EXPECT_NEAR(m.energy, ellipse.energy(), 1e-10);
    EXPECT_NEAR(m.momentum, ellipse.angular_momentum(), 1e-9);
    EXPECT_NEAR(m.radial, 0, 1e-14);
    EXPECT_NEAR(circle.at(period(circle)).azimuth, 2 * std::numbers::pi, 1e-13);
  }
}

}  // namespace
}  // namespace domefall
