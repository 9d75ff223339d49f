#include "pipeline/report/integrated_fall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

double energy(const FallState& p) { return p.gamma - std::sqrt(2 / p.r) * p.radial; }

// A falling body of this energy and angular momentum at r > 2.  Its r' is
// -sqrt(E^2 - (1 - 2/r)(1 + L^2/r^2)), and its gamma is E + s w with w = r' + s gamma.
FallState falling(double r, double e, double l) {
  const double s = std::sqrt(2 / r), v = l / r;
  const double speed = -std::sqrt(std::max(0.0, e * e - (1 - 2 / r) * (1 + v * v)));
  const double gamma = (e + s * speed) / (1 - 2 / r);
  return {r, 0, gamma, speed + s * gamma, v};
}

std::vector<double> evenly(double end, int count) {
  std::vector<double> taus;
  for (int k = 1; k <= count; ++k) taus.push_back(end * k / count);
  return taus;
}

constexpr FallMethod kMethods[] = {FallMethod::kDopri5, FallMethod::kFehlberg78};

// This orbit has no closed form: it leads round the hole, through the horizon and to the
// singularity.
TEST(FreeFall, KeepsEnergyAngularMomentumAndNormThroughTheHorizon) {
  const double e = 0.97, l = 3.2;
  for (const FallMethod method : kMethods) {
    const auto states = integrate_fall(falling(12, e, l), evenly(200, 2000), method, 1e-12);
    int inside = 0;
    for (const FallState& p : states) {
      if (p.r < 0.01) break;
      inside += p.r < 2;
      // gamma grows like r^(-3/2), and the constants are differences of such numbers.
      const double scale = p.gamma * p.gamma * 1e-10;
      EXPECT_NEAR(energy(p), e, scale);
      EXPECT_NEAR(p.r * p.tangential, l, scale);
      EXPECT_NEAR(p.gamma * p.gamma - p.radial * p.radial - p.tangential * p.tangential, 1, scale);
    }
    EXPECT_GT(inside, 3);
    EXPECT_EQ(states.back().r, 0) << "the end of every fall";
    EXPECT_GT(states.back().azimuth, 1);
  }
}

// With E = 1 and L >= 4 the condition r' = 0 is 2/r - L^2/r^2 + 2 L^2/r^3 = 0, a quadratic equation
// in 1/r.  Its smaller root gives the pericentre 1/(1/4 - sqrt(1/16 - 1/L^2)).
TEST(FreeFall, AParabolaTurnsAtItsPericentre) {
  const double l = 5, pericentre = 1 / (0.25 - std::sqrt(1.0 / 16 - 1 / (l * l)));
  for (const FallMethod method : kMethods) {
    const auto states = integrate_fall(falling(30, 1, l), evenly(160, 16000), method, 1e-11);
    const auto nearest = std::ranges::min_element(states, {}, &FallState::r);
    EXPECT_NEAR(nearest->r, pericentre, 1e-5);  // the states are 0.01 M apart
    EXPECT_GT(states.back().r, pericentre + 5) << "on its way out";
  }
}

// Far from the hole an orbit is Kepler's, with the period 2 pi a^(3/2).  Its pericentre advances by
// 6 pi/p.
TEST(FreeFall, FarAwayTheOrbitIsKeplersWithEinsteinsPrecession) {
  const double a = 1e5, eccentricity = 0.5, p = a * (1 - eccentricity * eccentricity);
  // E and L are exact for the turning points that p and e give.
  const double l = std::sqrt(p * p / (p - 3 - eccentricity * eccentricity));
  const double apocentre = p / (1 - eccentricity), v = l / apocentre, s = std::sqrt(2 / apocentre);
  const double gamma = std::sqrt((1 + v * v) / (1 - s * s));
  const FallState start{apocentre, 0, gamma, s * gamma, v};
  const double period = 2 * std::numbers::pi * a * std::sqrt(a);
  const auto states =
      integrate_fall(start, evenly(1.001 * period, 2002), FallMethod::kFehlberg78, 1e-12);
  const auto furthest =
      std::max_element(states.end() - 5, states.end(),
                       [](const FallState& x, const FallState& y) { return x.r < y.r; });
  EXPECT_NEAR(furthest->r / apocentre, 1, 1e-6);
  // The azimuth where r' = 0 follows from the nearest state, by r' = r'' dt and the angular speed
  // v/r.
  const double precession = 6 * std::numbers::pi / p;
  const FallState& q = *furthest;
  const double speed = q.radial - std::sqrt(2 / q.r) * q.gamma;
  const double l_over_r = q.tangential;
  const double pull = -1 / (q.r * q.r) + l_over_r * l_over_r * (q.r - 3) / (q.r * q.r);
  const double azimuth = q.azimuth - speed / pull * q.tangential / q.r;
  EXPECT_NEAR(azimuth - 2 * std::numbers::pi, precession, 0.01 * precession);
}

TEST(FreeFall, FromTheRainsOwnStateHasTheRainsFall) {
  const double from = 30, to = 0.5;
  const double tau = std::numbers::sqrt2 / 3 * (std::pow(from, 1.5) - std::pow(to, 1.5));
  for (const FallMethod method : kMethods)
    EXPECT_NEAR(integrate_fall({from, 0, 1, 0, 0}, {tau}, method, 1e-12)[0].r, to, 1e-7);
}

// States between two steps are reached by steps of their own, so asking for more of them changes
// none.
TEST(FreeFall, DoesNotDependOnHowManyStatesAreWanted) {
  const FallState start = falling(12, 0.97, 4);
  for (const FallMethod method : kMethods) {
    const FallState alone = integrate_fall(start, {100}, method, 1e-8)[0];
    const FallState among = integrate_fall(start, evenly(100, 500), method, 1e-8).back();
    EXPECT_EQ(alone.r, among.r);
    EXPECT_EQ(alone.azimuth, among.azimuth);
  }
}

}  // namespace
}  // namespace domefall
