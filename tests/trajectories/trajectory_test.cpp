#include "trajectories/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

double celerity_gamma(const V3d& celerity) { return std::sqrt(1 + celerity.dot(celerity)); }

// gamma between two observers given by their celerities against the same tetrad.
double relative_gamma(const V3d& a, const V3d& b) {
  return celerity_gamma(a) * celerity_gamma(b) - a.dot(b);
}

// Killing energy u.xi, with xi = T + sqrt(2/r) R in the rain tetrad.
double energy(const OrbitPoint& p) {
  return celerity_gamma(p.celerity) - std::sqrt(2 / p.r) * p.celerity.x;
}

TEST(CircularOrbit, AtSixMTheSpeedIsHalfThatOfLight) {
  const OrbitPoint p = point_at(CircularOrbit{6}, 0);
  const double gamma = relative_gamma(p.celerity, resting_celerity(6));
  EXPECT_NEAR(std::sqrt(1 - 1 / (gamma * gamma)), 0.5, 1e-15);
}

// [Riazuelo] app. app_img: 0.189 c at r = 30 M.
TEST(CircularOrbit, AtThirtyMTheSpeedIsThePapers) {
  const double gamma =
      relative_gamma(point_at(CircularOrbit{30}, 0).celerity, resting_celerity(30));
  EXPECT_NEAR(std::sqrt(1 - 1 / (gamma * gamma)), 1 / std::sqrt(28.0), 1e-14);
}

TEST(CircularOrbit, HasTheEnergyAndAngularMomentumOfItsRadius) {
  for (double r : {3.0001, 4.0, 6.0, 10.0, 1e6}) {
    const OrbitPoint p = point_at(CircularOrbit{r}, 1);
    EXPECT_NEAR(energy(p), (1 - 2 / r) / std::sqrt(1 - 3 / r), 1e-11);
    EXPECT_NEAR(r * p.celerity.z, std::sqrt(r / (1 - 3 / r)), 1e-9 * r);
  }
}

TEST(CircularOrbit, OnePeriodIsOneTurn) {
  const CircularOrbit orbit{6};
  EXPECT_NEAR(point_at(orbit, period(orbit)).azimuth, 2 * std::numbers::pi, 1e-14);
}

TEST(StaticObserver, HasNoRadialVelocityAgainstInfinity) {
  for (double r : {2 + 1e-9, 2.5, 30.0}) {
    const OrbitPoint p = point_at(StaticObserver{r}, 5);
    const double dr_dtau = p.celerity.x - std::sqrt(2 / r) * celerity_gamma(p.celerity);
    EXPECT_NEAR(dr_dtau / celerity_gamma(p.celerity), 0, 1e-9);
    EXPECT_EQ(p.region, Region::kI);
  }
}

TEST(StaticObserver, IsAtRestInFlatSpace) {
  EXPECT_EQ(point_at(StaticObserver{}, 1).celerity, V3d(0, 0, 0));
}

TEST(RadialInfall, ReachesEachRadiusAtItsProperTime) {
  const RadialInfall fall{30};
  for (double r : {29.999999, 10.0, 2.0, 1.0, 0.05}) {
    EXPECT_NEAR(point_at(fall, proper_time_to(fall, r)).r, r, 1e-12);
  }
}

// From the horizon the singularity is (sqrt 2/3) 2^(3/2) = 4/3 M away.
TEST(RadialInfall, LivesFourThirdsOfMBelowTheHorizon) {
  EXPECT_NEAR(lifetime(RadialInfall{2}), 4.0 / 3, 1e-15);
}

TEST(RadialInfall, MovesAtSqrtTwoOverR) {
  const RadialInfall fall{30};
  const double tau = double(proper_time_to(fall, 8)), h = 1e-4;
  const double speed = (point_at(fall, tau - h).r - point_at(fall, tau + h).r) / (2 * h);
  EXPECT_NEAR(speed, 0.5, 1e-9);
}

TEST(RadialInfall, CrossesFromRegionOneToTwo) {
  const RadialInfall fall{3};
  EXPECT_EQ(point_at(fall, proper_time_to(fall, 2.001)).region, Region::kI);
  EXPECT_EQ(point_at(fall, proper_time_to(fall, 1.999)).region, Region::kII);
}

TEST(GivenVelocity, ComposesTheFrameAndTheSpeed) {
  const auto frame = resting_celerity(10);
  for (const V3d& d : {V3d(1, 0, 0), V3d(0, 0.6, 0.8), V3d(-1, 0, 0)}) {
    const V3d u = celerity_against(frame, Celerity<RestFrame>(d * 2.0));
    EXPECT_NEAR(relative_gamma(u, frame), std::sqrt(5.0), 1e-13);
  }
}

TEST(GivenVelocity, MovingInwardAtFreeFallSpeedAgainstTheStaticFrameIsTheRain) {
  const V3d u =
      celerity_against(resting_celerity(8), Celerity<RestFrame>(-std::sqrt(1.0 / 3), 0, 0));
  EXPECT_LT(u.length(), 1e-15);
}

// v = t + r*, by the rates dv/dtau of [Riazuelo]'s orbits: u^t/(1 - 2/r) + u^r/(1 - 2/r).
TEST(Trajectory, TheNullTimeAdvancesAsTheOrbitsVelocitySays) {
  const auto rate = [](const Trajectory& t, double tau) {
    const double h = 1e-4;
    return double(point_at(t, tau + h).null_time - point_at(t, tau - h).null_time) / (2 * h);
  };
  EXPECT_NEAR(rate(StaticObserver{20}, 3), 1 / std::sqrt(0.9), 1e-9);
  EXPECT_NEAR(rate(CircularOrbit{6}, 3), std::sqrt(2.0), 1e-9);
  const RadialInfall fall{8};
  for (const double r : {7.0, 3.0, 2.0, 1.0, 0.3}) {
    const double s = std::sqrt(2 / r);
    EXPECT_NEAR(rate(fall, double(proper_time_to(fall, r))), 1 / (1 + s), 1e-5) << r;
  }
  EXPECT_NEAR(double(point_at(Trajectory(fall), 0).null_time), 0, 1e-13);
}

}  // namespace
}  // namespace domefall
