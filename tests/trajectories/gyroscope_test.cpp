// Gyroscopes near holes.
#include "trajectories/gyroscope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trajectories/circular_orbit.h"
#include "trajectories/kerr_orbit.h"

namespace domefall {
namespace {

using std::numbers::pi;

double angle_of(const M33d& turn) {
  return std::acos(std::clamp((turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2, -1.0, 1.0));
}

KerrCircling circle(double spin, double r, bool prograde) {
  const KerrHole hole{spin, 0};
  const auto free = kerr_circle(hole, r, prograde);
  return {hole, r, pi / 2, free->angle / free->time};
}
OrbitPoint on_equator(OrbitPoint point) {
  point.theta = pi / 2;
  return point;
}
double azimuth_rate(const KerrCircling& c) { return c.at(1).azimuth; }

// Against the observer's own axes it turns back by sqrt(M/r^3) of proper time, about any hole.  So
// against the stars it turns forward by 2 pi (1 - sqrt(1 - 3M/r)) a revolution about one without spin.
TEST(Gyroscope, OnACircleTurnsByKeplersRate) {
  for (const double spin : {0.0, 0.5, 0.9, 0.998})
    for (const double r : {6.5, 8.0, 30.0})
      for (const bool prograde : {true, false}) {
        if (!kerr_circle({spin, 0}, r, prograde)) continue;
        const KerrCircling orbit = circle(spin, r, prograde);
        const auto even = Gyroscope::held({spin, 0}, orbit.at(0), azimuth_rate(orbit), 0);
        const double tau = 2, rate = std::pow(r, -1.5);
        EXPECT_NEAR(angle_of(even.turn(tau)), rate * tau, 1e-13) << spin << " " << r;
        if (spin == 0) {
          // The same in the tetrad of rain.
          const CircularOrbit rain{r};
          EXPECT_NEAR(
              angle_of(Gyroscope::held({0, 0, true}, on_equator(rain.at(0)), rain.at(1).azimuth, 0)
                           .turn(tau)),
              rate * tau, 1e-13);
          const double revolution = 2 * pi / std::abs(azimuth_rate(orbit));
          EXPECT_NEAR(2 * pi - rate * revolution, 2 * pi * (1 - std::sqrt(1 - 3 / r)), 1e-12);
        }
        // The same as a fall and as a flight.
        const auto way = [&](const ProperTime& t) { return orbit.at(t); };
        for (const bool free : {true, false}) {
          const auto followed = Gyroscope::along({spin, 0}, way, free, 0, 300);
          const M33d apart = even.turn(271).transposed() * followed.turn(271);
          for (int k = 0; k < 3; ++k) EXPECT_NEAR(apart[k][k], 1, 1e-8) << free;
          EXPECT_NEAR(apart[0][2], 0, free ? 1e-9 : 1e-6);
        }
      }
}

// Far away it turns by J (3 cos theta r - z)/r^3, which is 2J/r^3 on the axis and -J/r^3 in the equator.
TEST(Gyroscope, AtRestFarAwayTurnsAsLenseAndThirringFound) {
  const double spin = 0.9, r = 1e4, tau = 1e9;
  const auto turned = [&](double theta) {
    const KerrCircling rest{{spin, 0}, r, theta, 0};
    return Gyroscope::held({spin, 0}, rest.at(0), 0, 0).turn(tau);
  };
  const double unit = spin * tau / (r * r * r);
  // About R, which points to the north there; and about Theta, which points to the south.
  EXPECT_NEAR(turned(1e-6)[2][1], 2 * unit, 1e-3 * unit);
  EXPECT_NEAR(turned(pi / 2)[0][2], unit, 1e-3 * unit);
}

// The tensor of Killing and Yano, a cos(theta) T^R + r Theta^Phi, takes the four-velocity of any
// geodesic to a vector that goes along parallel to itself.
V3d yano_leg(const KerrOrbit& orbit, double a, double tau) {
  const OrbitPoint p = orbit.at(tau);
  const V3d& c = p.celerity;
  const double time = gamma_of(c), along = a * std::cos(p.theta);
  const V3d leg(along * time, p.r * c.z, -p.r * c.y);
  return leg - c * (along * c.x - c.dot(leg) / (1 + time));
}

TEST(Gyroscope, InFreeFallCarriesTheLegOfKillingAndYano) {
  const double a = 0.9;
  const KerrHole hole{a, 0};
  for (const double inclination : {0.5, 1.3, pi / 2}) {
    const KerrOrbit orbit(hole, 6, pi / 2, kerr_bound(hole, 6, 12, inclination).value());
    const auto way = [&](const ProperTime& t) { return orbit.at(t); };
    const auto gyroscope = Gyroscope::along({a, 0}, way, true, 0, 1000);
    const V3d begin = yano_leg(orbit, a, 0);
    for (const double tau : {3.0, 100.0, 333.0, 999.0})
      EXPECT_LT((apply(gyroscope.turn(tau), begin) - yano_leg(orbit, a, tau)).length(),
                1e-9 * begin.length())
          << inclination << " " << tau;
  }
}

}  // namespace
}  // namespace domefall
