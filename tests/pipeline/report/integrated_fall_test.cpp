#include "pipeline/report/integrated_fall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

double energy(const FallState& p) { return p.gamma - std::sqrt(2 / p.r) * p.radial; }

// A body of this energy and angular momentum, falling: r' = -sqrt(E^2 - (1 - 2/r)(1 + L^2/r^2)) and
// gamma = E + s w with w = r' + s gamma.  r > 2.
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

// Not one of the closed forms: round the hole, through the horizon, to the singularity.
TEST(FreeFall, KeepsEnergyAngularMomentumAndNormThroughTheHorizon) {
  const double e = 0.97, l = 3.2;
  for (const FallMethod method : kMethods) {
    const auto states = integrate_fall(falling(12, e, l), evenly(200, 2000), method, 1e-12);
    int inside = 0;
    for (const FallState& p : states) {
      if (p.r < 0.01) break;
      inside += p.r < 2;
      // gamma grows as r^(-3/2); what is kept is a difference of its like.
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

// E = 1 and L >= 4: r_per = 1/(1/4 - sqrt(1/16 - 1/L^2)), independent of all that is
// integrated.
TEST(FreeFall, AParabolaTurnsAtItsPericentre) {
  const double l = 5, pericentre = 1 / (0.25 - std::sqrt(1.0 / 16 - 1 / (l * l)));
  for (const FallMethod method : kMethods) {
    const auto states = integrate_fall(falling(30, 1, l), evenly(160, 16000), method, 1e-11);
    const auto nearest =
        std::min_element(states.begin(), states.end(),
                         [](const FallState& a, const FallState& b) { return a.r < b.r; });
    EXPECT_NEAR(nearest->r, pericentre, 1e-5);  // states 0.01 M apart
    EXPECT_GT(states.back().r, pericentre + 5) << "on its way out";
  }
}

// From far away an orbit is Kepler's, whose period is 2 pi a^(3/2); its pericentre moves on by 6 pi/p.
TEST(FreeFall, FarAwayTheOrbitIsKeplersWithEinsteinsPrecession) {
  const double a = 1e5, eccentricity = 0.5, p = a * (1 - eccentricity * eccentricity);
  // Exact for these turning points, with p and e in the place of E and L.
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
  // Where r' = 0, by the speed beside it: r' = r'' dt and the azimuth goes on at v/r.
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

// States between two steps are reached by steps of their own: more of them change none.
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
