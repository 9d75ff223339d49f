#include "trajectories/geodesic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/trajectories/motion.h"
#include "trajectories/bound_orbit.h"
#include "trajectories/circular_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/kruskal_crossing.h"
#include "trajectories/orbit_table.h"
#include "trajectories/parabolic_orbit.h"
#include "trajectories/radial_infall.h"
#include "trajectories/static_observer.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct Named {
  std::string name;
  Geodesic orbit;
};

std::vector<Named> every_kind() {
  return {{"parabolic", parabolic_by_periastron(10)},
          {"parabolic whirl", parabolic_by_excess(1e-12)},
          {"hyperbolic", hyperbolic_by_periastron(0.6, 3.9)},
          {"fast hyperbolic", hyperbolic_by_periastron(0.999999, 3.2)},
          {"bound", bound_by_turning_points(10, 20)},
          {"bound whirl", bound_by_excess(0.5, 1e-8)},
          {"fall from rest", fall_from_rest(10, 3)},
          {"fall from infinity", fall_from_infinity(3.9, 30)},
          {"fall with speed", fall_with_speed(0.5, 3, 30)},
          {"thrown up", thrown_outside(10, 0.2, 0.1)},
          {"thrown in fast", thrown_outside(10, -1e6, 1e3)},
          {"escaping", thrown_outside(10, 2, 0.1)},
          {"thrown inside", thrown_from_rain(1, 0.5, 1)},
          {"from region III", thrown_from_rain(1, 3, 1)},
          {"through the apex", kruskal_crossing(0, 2)},
          {"IV to II", kruskal_crossing(0.5, 1)},
          {"IV to I", kruskal_crossing(2, 1)},
          {"III to II", mirrored(fall_from_rest(10, 3))}};
}

// Proper times from near the begin to near the end of a life, within 1e4 M.
std::vector<double> instants(const Geodesic& orbit) {
  const double begin = std::max(orbit.birth(), -1e4), end = std::min(orbit.death(), 1e4);
  std::vector<double> taus;
  for (int k = 1; k < 200; ++k) taus.push_back(begin + (end - begin) * k / 200);
  return taus;
}

TEST(Geodesic, EnergyAndAngularMomentumOfItsStatesAreConstant) {
  for (const auto& [name, orbit] : every_kind())
    for (const double tau : instants(orbit)) {
      const OrbitPoint p = orbit.at(tau);
      EXPECT_NEAR(energy_of(p), orbit.energy(), 1e-13 * gamma_of(p)) << name << ' ' << tau;
      EXPECT_NEAR(angular_momentum_of(p), orbit.angular_momentum(),
                  1e-15 * orbit.angular_momentum())
          << name << ' ' << tau;
      EXPECT_TRUE(has_tetrad(p.region, p.tetrad)) << name << ' ' << tau;
      EXPECT_TRUE(std::isfinite(double(p.null_time))) << name << ' ' << tau;
    }
}

TEST(Geodesic, StartsWithAzimuthZero) {
  for (const auto& [name, orbit] : every_kind()) {
    if (orbit.energy() == 0) continue;  // the state beside the apex
    EXPECT_NEAR(orbit.at(0).azimuth, 0, 1e-15) << name;
    EXPECT_NEAR(double(orbit.at(0).null_time), 0, 1e-13) << name;
  }
}

TEST(Geodesic, TimeAtIsTheInverseOfAt) {
  for (const auto& [name, orbit] : every_kind())
    for (const double tau : instants(orbit)) {
      const OrbitPoint p = orbit.at(tau);
      if (orbit.energy() == 0 && std::abs(tau) < 0.01) continue;
      const Leg leg = radial_speed_of(p) > 0 ? Leg::kOutward : Leg::kInward;
      const auto found = orbit.time_at(p.r, leg, tau - 0.1);
      ASSERT_TRUE(found.has_value()) << name << ' ' << tau;
      EXPECT_NEAR(orbit.at(*found).r / p.r, 1, 2e-13) << name << ' ' << tau;
      // A rounding of r moves tau by that over the speed.
      if (std::abs(radial_speed_of(p)) > 1e-3) {
        EXPECT_NEAR(double(*found), tau, 1e-11 + 1e-14 * std::abs(tau)) << name;
      }
    }
}

TEST(Geodesic, ARadiusNeverPassedHasNoTime) {
  EXPECT_FALSE(parabolic_by_periastron(10).time_at(9.99, Leg::kInward));
  EXPECT_FALSE(fall_from_infinity(1, 10).time_at(5, Leg::kOutward));
  EXPECT_FALSE(kruskal_crossing(2).time_at(5, Leg::kInward));
  EXPECT_FALSE(fall_from_rest(10, 1).time_at(5, Leg::kInward, 1e3));
  EXPECT_FALSE(bound_by_turning_points(10, 20).time_at(21, Leg::kInward));
  EXPECT_FALSE(parabolic_by_periastron(10).time_at(std::nan(""), Leg::kInward));
}

// E^2 - 1 = -(2/r_a) (1 - ...): the root was found to 1e-16 of the place where the orbit begins.
TEST(Geodesic, AnApoastronFarAwayKeepsItsDigits) {
  for (const double energy : {0.999, 0.9999999, 0.99999999, 0.999999999999}) {
    const double far = 2 / ((1 - energy) * (1 + energy));
    EXPECT_NEAR(kruskal_crossing(energy).outermost() / far, 1, 1e-15) << energy;
  }
  // Thrown on at the periastron of orbits whose turning points are known.
  for (const double far : {1e3, 1e6, 1e9}) {
    const Geodesic orbit = bound_by_turning_points(10, far);
    const double excess = (orbit.energy() - 1) * (orbit.energy() + 1);
    const double celerity = orbit.angular_momentum() / 10;
    const double lost = 1e-15 / std::abs(excess);  // rounding of the celerity
    EXPECT_NEAR(thrown_outside(10, 0, celerity).outermost() / far, 1, lost) << far;
  }
}

TEST(Geodesic, ABoundOrbitPassesAgainEveryPeriod) {
  const Geodesic orbit = bound_by_turning_points(10, 20);
  const double first = double(orbit.time_at(15, Leg::kOutward).value()),
               period = orbit.radial_period();
  EXPECT_GE(first, 0);
  EXPECT_LT(first, period);
  EXPECT_NEAR(double(orbit.time_at(15, Leg::kOutward, first + 1).value()), first + period,
              1e-12 * period);
  EXPECT_NEAR(double(orbit.time_at(15, Leg::kOutward, -3.5 * period).value()), first - 3 * period,
              1e-12 * period);
  EXPECT_NEAR(orbit.at(period).r, 10, 1e-12);
  EXPECT_NEAR(orbit.at(1e6 * period).r, 10, 1e-8);
  EXPECT_NEAR(orbit.at(1e6 * period).azimuth / (1e6 * orbit.azimuth_per_period()), 1, 1e-12);
}

// Weak field: 6 pi/p radians a turn.
TEST(Geodesic, MercurysPerihelionAdvancesBySixPiOverP) {
  const double p = 1e6, e = 0.2;
  EXPECT_NEAR((bound_by_shape(p, e).azimuth_per_period() - 2 * pi) / (6 * pi / p), 1, 1e-4);
}

// Near the periastron dphi/dchi = sqrt(p/(p - 6 - 2e + e chi^2)), whose integral over both sides
// grows by sqrt((6 + 2e)/e) ln 10 with every digit of the excess.
TEST(Geodesic, TheWhirlGrowsWithTheLogarithmOfTheSeparatrixsDistance) {
  const double e = 0.5, rate = std::sqrt((6 + 2 * e) / e);
  for (const double excess : {1e-8, 1e-11, 1e-14}) {
    const double nearer = bound_by_excess(e, excess / 10).azimuth_per_period();
    const double farther = bound_by_excess(e, excess).azimuth_per_period();
    EXPECT_NEAR(nearer - farther, rate * std::log(10.0), 30 * excess + 1e-12) << excess;
  }
}

// [Riazuelo] eq. vit_par.
TEST(Geodesic, AParabolasSpeedAtPeriastronIsRootTwoOverR) {
  for (const double r : {4.001, 6.0, 100.0}) {
    const OrbitPoint p = parabolic_by_periastron(r).at(0);
    const V3d still = resting_celerity(r);
    const double gamma = gamma_of(p) * std::sqrt(1 + still.dot(still)) - p.celerity.dot(still);
    EXPECT_NEAR(std::sqrt(1 - 1 / (gamma * gamma)), std::sqrt(2 / r), 1e-14);
  }
}

TEST(Geodesic, RadialFallFromInfinityIsTheRain) {
  const RadialInfall rain{10};
  const Geodesic orbit = fall_from_infinity(0, 10);
  EXPECT_NEAR(orbit.death(), lifetime(Trajectory(rain)), 1e-14);
  for (const double r : {9.0, 2.0, 1.0, 0.01}) {
    const ProperTime tau = proper_time_to(rain, r);
    const OrbitPoint p = orbit.at(tau), q = point_at(rain, tau);
    EXPECT_NEAR(p.r, q.r, 1e-13 + 1e-15 / r);
    EXPECT_NEAR(double(p.null_time), double(q.null_time), 1e-13 + 1e-15 / r);
    EXPECT_LT(p.celerity.length(), 1e-13);
  }
}

TEST(Geodesic, WhatIsThrownAroundIsTheCircularOrbit) {
  const double r = 10, speed = 1 / std::sqrt(r - 3);
  const Geodesic orbit = thrown_outside(r, 0, speed);
  for (const double tau : {1.0, 100.0, 1e4}) {
    const OrbitPoint p = orbit.at(tau), q = point_at(CircularOrbit{r}, tau);
    EXPECT_NEAR(p.r, r, 1e-13);
    EXPECT_NEAR(p.azimuth, q.azimuth, 1e-14 * tau);
    EXPECT_NEAR(double(p.null_time), double(q.null_time), 1e-13 + 1e-14 * tau);
  }
}

// [Riazuelo] sec. sec_Kruskal: r = 1 + cos eta, tau = eta + sin eta.
TEST(Geodesic, TheApexOrbitIsTheCycloid) {
  const Geodesic orbit = kruskal_crossing(0);
  EXPECT_NEAR(orbit.death(), pi, 1e-15);
  EXPECT_NEAR(orbit.birth(), -pi, 1e-15);
  for (const double eta : {-3.0, -1.0, -0.1, 0.1, 1.0, 2.0, 3.0}) {
    const OrbitPoint p = orbit.at(eta + std::sin(eta));
    EXPECT_NEAR(p.r, 1 + std::cos(eta), 2e-14);
    EXPECT_EQ(p.region, eta < 0 ? Region::kIV : Region::kII);
    EXPECT_NEAR(p.celerity.x, resting_celerity(p.r, p.tetrad).x, 1e-13 * gamma_of(p));
    EXPECT_NEAR(double(p.null_time), (eta < 0 ? -1 : 1) * tortoise_of(p.r), 1e-11);
  }
}

TEST(Geodesic, AtTheApexItselfTheStateIsThatBesideIt) {
  for (const double momentum : {0.0, 2.0})
    for (const double tau : {-1e-7, -1e-300, 0.0, 1e-300, 1e-7}) {
      const OrbitPoint p = kruskal_crossing(0, momentum).at(tau);
      EXPECT_NEAR(p.r, 2, 1e-11);
      EXPECT_LT(p.r, 2);
      EXPECT_TRUE(std::isfinite(gamma_of(p)) && std::isfinite(double(p.null_time)));
      EXPECT_LT(gamma_of(p), 1e7);
      if (std::abs(tau) > 1e-8) {
        EXPECT_EQ(p.tetrad, tau < 0 ? Tetrad::kOutgoing : Tetrad::kRain);
      }
      EXPECT_NEAR(energy_of(p), 0, 1e-9);
    }
}

TEST(Geodesic, OutsideForEverMeansRainForEver) {
  for (const Geodesic& orbit : {parabolic_by_periastron(5), hyperbolic_by_periastron(0.7, 5),
                                bound_by_turning_points(7, 8)})
    for (const double tau : instants(orbit)) {
      EXPECT_EQ(orbit.at(tau).tetrad, Tetrad::kRain);
      EXPECT_EQ(orbit.at(tau).region, Region::kI);
    }
}

TEST(Geodesic, FromThePastSingularityTheTetradIsOutgoingUntilTheApoastron) {
  const Geodesic orbit = kruskal_crossing(0.8);
  const double horizon = double(orbit.time_at(2, Leg::kOutward).value());
  EXPECT_EQ(orbit.at(horizon * 1.001).region, Region::kIV);
  EXPECT_EQ(orbit.at(horizon * 0.999).region, Region::kI);
  EXPECT_EQ(orbit.at(-1e-9).tetrad, Tetrad::kOutgoing);
  EXPECT_EQ(orbit.at(1e-9).tetrad, Tetrad::kRain);
  EXPECT_EQ(orbit.at(-horizon * 0.999).region, Region::kI);
  EXPECT_EQ(orbit.at(-horizon * 1.001).region, Region::kII);
}

TEST(Geodesic, WhatIsThrownUpIsInRainFromTheThrowOn) {
  const Geodesic orbit = thrown_outside(10, 0.2, 0.1);
  EXPECT_EQ(orbit.at(-1e-9).tetrad, Tetrad::kOutgoing);
  for (const double tau : {1e-9, 1.0, 70.0}) EXPECT_EQ(orbit.at(tau).tetrad, Tetrad::kRain);
}

// One four-velocity, one t: at the change of tetrad v - u = 2 r*.
TEST(Geodesic, TheChangeOfTetradIsOne) {
  for (const Geodesic& orbit :
       {kruskal_crossing(0.8), kruskal_crossing(0.9, 2.5), fall_from_rest(2.001, 1),
        thrown_outside(10, 0.2, 0.1), thrown_outside(3, 5, 1)}) {
    const double h = 1e-9;
    const OrbitPoint before = orbit.at(-h), after = orbit.at(h);
    EXPECT_NE(before.tetrad, after.tetrad);
    const double speed = std::abs(radial_speed_of(after)) + 1e-6;
    EXPECT_NEAR(before.r, after.r, 3 * h * speed + 1e-14);
    EXPECT_NEAR(radial_speed_of(before), radial_speed_of(after), 1e-8);
    EXPECT_NEAR(before.azimuth, after.azimuth, 1e-8);
    EXPECT_NEAR(double(after.null_time - before.null_time), 2 * tortoise_of(after.r),
                1e-6 + 1e-11 / (after.r - 2));
  }
}

// Frames at any rate: what changes over the horizon is proportional to the step.
TEST(Geodesic, NothingJumpsAtTheHorizon) {
  for (const auto& [name, orbit] : every_kind())
    for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
      const auto horizon = orbit.time_at(2, leg);
      if (!horizon || orbit.energy() == 0 || orbit.energy() > 1e3) continue;
      const auto change = [&orbit = orbit, &horizon](double h) {
        const OrbitPoint a = orbit.at(*horizon - h), b = orbit.at(*horizon + h);
        EXPECT_EQ(a.tetrad, b.tetrad);
        EXPECT_NE(a.region, b.region);
        return std::array{(b.r - a.r) / h, (b.azimuth - a.azimuth) / h,
                          (b.celerity.x - a.celerity.x) / h, double(b.null_time - a.null_time) / h};
      };
      const auto wide = change(1e-4);
      for (const double h : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
        const auto narrow = change(h);
        for (std::size_t k = 0; k < wide.size(); ++k)
          EXPECT_NEAR(narrow[k], wide[k], 1e-5 * (1 + std::abs(wide[k])) + 1e-13 / h)
              << name << ' ' << h << ' ' << k;
      }
    }
}

TEST(Geodesic, MirroredExchangesTheSkiesAndNothingElse) {
  const Geodesic orbit = kruskal_crossing(2, 1), mirror = mirrored(orbit);
  const OrbitPoint p = orbit.at(3), q = mirror.at(3), again = mirrored(mirror).at(3);
  EXPECT_EQ(q.region, Region::kIII);
  EXPECT_EQ(q.tetrad, Tetrad::kOutgoingToThree);
  EXPECT_EQ(q.r, p.r);
  EXPECT_EQ(q.celerity, p.celerity);
  EXPECT_EQ(again.tetrad, p.tetrad);
  EXPECT_EQ(again.region, p.region);
}

// Inside with E < 0: the same place and motion as asked for, said by the other tetrad.
TEST(Geodesic, NegativeEnergyInsideComesFromRegionThree) {
  const double r = 1, s = std::sqrt(2.0);
  const V3d asked(3, 0, 1);
  const double gamma = std::sqrt(1 + asked.dot(asked));
  const Geodesic orbit = thrown_from_rain(r, asked.x, asked.z);
  const OrbitPoint p = orbit.at(0);
  EXPECT_EQ(p.tetrad, Tetrad::kRainOfThree);
  EXPECT_NEAR(orbit.energy(), s * asked.x - gamma, 1e-14);
  EXPECT_NEAR(radial_speed_of(p), asked.x - s * gamma, 1e-14);
  EXPECT_EQ(orbit.at(orbit.time_at(3, Leg::kInward).value()).region, Region::kIII);
}

// At rest in t inside, as rounding has it: the apex orbit.
TEST(Geodesic, AtRestInTInsideHasNoEnergy) {
  for (const double r : {0.3, 1.0, 1.9}) {
    const Geodesic orbit = thrown_from_rain(r, resting_celerity(r).x, 0);
    EXPECT_EQ(orbit.energy(), 0);
    EXPECT_EQ(orbit.outermost(), 2);
    EXPECT_NEAR(orbit.at(0).r, r, 1e-14);
    EXPECT_NEAR(orbit.death() - orbit.birth(), 2 * pi, 1e-13);
  }
}

// As little energy as can be told from none: the states stay finite, the switch of tetrads too.
TEST(Geodesic, NearlyNoEnergyInsideIsNoTrouble) {
  const double r = 1, rest = resting_celerity(r).x;
  for (const double more : {1e-12, 1e-9, 1e-6, -1e-12, -1e-9, -1e-6}) {
    const Geodesic orbit = thrown_from_rain(r, rest + more, 1e-3);
    for (const double tau : instants(orbit)) {
      const OrbitPoint p = orbit.at(tau);
      EXPECT_TRUE(std::isfinite(double(p.null_time)) && std::isfinite(gamma_of(p)))
          << more << ' ' << tau;
      EXPECT_NEAR(energy_of(p), orbit.energy(), 1e-13 * gamma_of(p)) << more << ' ' << tau;
    }
  }
}

// Next to the horizon the rain's own speed against the static observer is all there is to see:
// celerities of sqrt(2/(r - 2)) whose differences are the throw's.
TEST(Geodesic, AThrowIsTheCelerityAskedFor) {
  for (const double r : {2 + 1e-9, 2.01, 12.0})
    for (const double radial : {-1e6, -0.3, -1e-9, 0.0, 1e-9, 0.3, 1e6})
      for (const double tangential : {0.0, 1e-3, 0.4, 3.0}) {
        const OrbitPoint p = thrown_outside(r, radial, tangential).at(0);
        const double f = std::sqrt((r - 2) / r);
        const double gamma = std::hypot(1, std::hypot(radial, tangential));
        EXPECT_NEAR(p.r, r, 1e-14 * r) << radial << ' ' << tangential;
        EXPECT_NEAR(p.celerity.z, tangential, 1e-15 * (1 + tangential));
        EXPECT_NEAR(radial_speed_of(p), radial * f, 2e-15 * gamma_of(p) + 1e-14) << r;
        EXPECT_NEAR(energy_of(p), gamma * f, 2e-15 * gamma_of(p)) << r;
      }
}

TEST(Geodesic, BeyondItsLifeThereIsNoState) {
  const Geodesic orbit = fall_from_rest(10, 3);
  EXPECT_THROW(orbit.at(orbit.death() + 1), std::domain_error);
  EXPECT_THROW(orbit.at(orbit.birth() - 1), std::domain_error);
  EXPECT_THROW(orbit.at(std::nan("")), std::domain_error);
  EXPECT_THROW(parabolic_by_periastron(10).at(1e100), std::domain_error);
  EXPECT_THROW(bound_by_turning_points(10, 20).at(std::numeric_limits<double>::infinity()),
               std::domain_error);
  EXPECT_GT(orbit.at(std::nextafter(orbit.death(), 0.0)).r, 0);
}

TEST(Geodesic, IsATrajectoryLikeTheOthers) {
  const Trajectory fall = fall_from_rest(10, 3), parabola = parabolic_by_periastron(10);
  EXPECT_EQ(lifetime(fall), std::get<Geodesic>(fall).death());
  EXPECT_TRUE(std::isinf(lifetime(parabola)));
  EXPECT_EQ(point_at(parabola, 5).r, std::get<Geodesic>(parabola).at(5).r);
}

}  // namespace
}  // namespace domefall
