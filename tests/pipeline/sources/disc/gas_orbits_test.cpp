// The gas about a charge, against the equations of motion and the conservation laws by quadrature.
#include "pipeline/sources/disc/gas_orbits.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

GasOrbits gas_about(long double charge) { return GasOrbits(ChargedHole(1, charge)); }

// Without a charge the numbers are Schwarzschild's, those of circles to the last bit and those of the
// plunge to rounding.
TEST(GasOrbits, WithoutAChargeAreThoseOfSchwarzschild) {
  const GasOrbits gas;
  EXPECT_EQ(gas.horizon(), 2);
  EXPECT_EQ(gas.last_stable(), 6);
  EXPECT_EQ(gas.plunge_energy(), std::sqrt(8.0 / 9));
  EXPECT_EQ(gas.plunge_momentum(), 2 * std::sqrt(3.0));
  for (const double r : {2.1, 3.7, 5.9}) {
    EXPECT_DOUBLE_EQ(gas.plunge_speed(r), (6 / r - 1) * std::sqrt(6 / r - 1) / 3);
    EXPECT_DOUBLE_EQ(gas.angular_velocity(r), (1 - 2 / r) * std::sqrt(13.5) / (r * r));
  }
  for (const double r : {6.0, 7.3, 1e4}) {
    EXPECT_EQ(gas.angular_velocity(r), 1 / (r * std::sqrt(r)));
    EXPECT_EQ(gas.shear(r), 1.5);
  }
}

TEST(GasOrbits, AreStableFromSixDownToFour) {
  EXPECT_DOUBLE_EQ(gas_about(1).last_stable(), 4);
  EXPECT_NEAR(gas_about(0.5L).last_stable(), 5.60664343, 1e-8);
  for (const double q : {0.1, 0.5, 0.95, 1.0}) {
    const double r = gas_about(q).last_stable(), q2 = q * q;
    EXPECT_NEAR(r * (r * (r - 6) + 9 * q2) - 4 * q2 * q2, 0, 1e-13) << q;
  }
}

// On a circle f u^t^2 - r^2 u^phi^2 = 1, and the pull of f balances the turning: f' = 2 r Omega^2.
TEST(GasOrbits, CirclesAreGeodesics) {
  for (const double q : {0.3, 0.8, 1.0}) {
    const GasOrbits gas = gas_about(q);
    for (const double r : {gas.last_stable(), 7.0, 20.0, 1e3}) {
      const double omega = gas.angular_velocity(r), f = 1 - 2 / r + q * q / (r * r);
      const double slope = 2 / (r * r) - 2 * q * q / (r * r * r);
      EXPECT_NEAR(slope / (2 * r * omega * omega), 1, 1e-14) << q << " " << r;
      EXPECT_NEAR((f - r * r * omega * omega) / gas.slowing_squared(r), 1, 1e-14);
      const double h = 1e-5, up = gas.angular_velocity(r * (1 + h)),
                   down = gas.angular_velocity(r * (1 + 2 * h));
      EXPECT_NEAR(-(std::log(down) - std::log(omega)) / std::log1p(2 * h), gas.shear(r * (1 + h)),
                  1e-8);
      EXPECT_LT(up, omega);
    }
  }
}

// (u^r)^2 = E^2 - f (1 + L^2/r^2), a difference that loses digits next to the last stable orbit.
TEST(GasOrbits, PlungeWithWhatTheLastStableOrbitHas) {
  for (const double q : {0.0, 0.3, 0.8, 1.0}) {
    const GasOrbits gas = gas_about(q);
    const double e = gas.plunge_energy(), l = gas.plunge_momentum(), edge = gas.last_stable();
    EXPECT_NEAR(gas.angular_velocity(std::nextafter(edge, 0)) / gas.angular_velocity(edge), 1,
                1e-14);
    for (const double part : {0.0, 0.01, 0.3, 0.7, 0.99}) {
      const double r = gas.horizon() + (edge - gas.horizon()) * part;
      const double f = 1 - 2 / r + q * q / (r * r), u = gas.plunge_speed(r);
      EXPECT_NEAR(u * u, e * e - f * (1 + l * l / (r * r)), 1e-14) << q << " " << r;
      EXPECT_NEAR(gas.angular_velocity(r), f * l / (e * r * r), 2e-16);
    }
  }
}

// [Page & Thorne 1974] eqs. 11b and 12, by quadrature, with E, L and Omega of circles about a
// charge.
class ByQuadrature {
 public:
  explicit ByQuadrature(long double charge)
      : q2_(charge * charge), edge_(gas_about(charge).last_stable()) {}
  double flux(long double r, double pull) const {
    const auto lost = [this](long double x) { return free(x) * slope(x); };
    const long double brought =
        r > edge_ ? boost::math::quadrature::gauss_kronrod<long double, 61>::integrate(
                        lost, edge_, r, 12, 1e-14L)
                  : 0;
    const long double steeper = (3 * r - 4 * q2_) / (2 * r * r * r * std::sqrt(r - q2_));
    return static_cast<double>(steeper / (r * free(r) * free(r)) *
                               (brought + free(edge_) * momentum(edge_) * pull));
  }

 private:
  long double slowing(long double r) const { return r * r - 3 * r + 2 * q2_; }
  long double momentum(long double r) const { return r * std::sqrt((r - q2_) / slowing(r)); }
  long double free(long double r) const {  // E - Omega L
    const long double energy = (r * r - 2 * r + q2_) / (r * std::sqrt(slowing(r)));
    return energy - std::sqrt(r - q2_) / (r * r) * momentum(r);
  }
  long double slope(long double r) const {  // dL/dr
    const long double log = 1 / r + 0.5L / (r - q2_) - (r - 1.5L) / slowing(r);
    return momentum(r) * log;
  }

  long double q2_, edge_;
};

TEST(PageThorneOfACharge, FollowsFromTheConservationLaws) {
  for (const double q : {0.0, 0.2, 0.5, 0.95, 1.0}) {
    const ByQuadrature truth(q);
    for (const double pull : {0.0, 0.02}) {
      const PageThorneProfile profile(pull > 0, gas_about(q));
      const double greatest = truth.flux(profile.hottest(), pull),
                   edge = gas_about(q).last_stable();
      for (const double over : {1.001, 1.05, 1.3, 1.6, 2.5, 10.0, 1e3})
        EXPECT_NEAR(profile.flux(edge * over) / (truth.flux(edge * over, pull) / greatest), 1,
                    1e-10)
            << q << " " << pull << " " << over;
    }
  }
}

// The hottest ring is 1.59 times as far as the last stable orbit without a charge, and nearer with
// one.  The flux there grows as the orbit moves in.
TEST(PageThorneOfACharge, IsHottestFurtherIn) {
  EXPECT_NEAR(PageThorneProfile(false, gas_about(1)).hottest(), 6.411, 0.001);
  double before = 9.56;
  for (const double q : {0.0, 0.3, 0.6, 0.9, 1.0}) {
    const double r = PageThorneProfile(false, gas_about(q)).hottest();
    EXPECT_LT(r, before);
    before = r;
  }
}

TEST(PageThorneOfACharge, IsThatOfPlungingGasDownToTheHorizon) {
  for (const double q : {0.5, 1.0}) {
    const GasOrbits gas = gas_about(q);
    const PageThorneProfile profile(true, gas);
    const double edge = gas.last_stable(), r = gas.horizon();
    EXPECT_NEAR(profile.flux(std::nextafter(edge, 0)), profile.flux(edge), 1e-9);
    EXPECT_EQ(profile.flux(r * 0.9999), 0);
    const double start = gas.plunge_speed(edge * (1 - 1e-9)) / std::pow(1 / (1 - 1e-9) - 1, 1.5);
    EXPECT_NEAR(
        profile.temperature(r),
        std::pow(edge / r, 17.0 / 28) * std::pow(1 + gas.plunge_speed(r) / start / 0.01, -1.0 / 28),
        1e-7);
  }
}

// What pixels take is within rounding of what probe says.
TEST(PageThorneOfACharge, IsTheLightOfManyPlaces) {
  for (const bool plunging : {false, true}) {
    Disc disc;
    disc.orbits = gas_about(0.9L);
    disc.plunging = plunging;
    const DiscLight light(disc);
    std::vector<float> r, g;
    for (int k = 1; k < 500; ++k) {
      r.push_back(
          static_cast<float>((plunging ? disc.orbits.horizon() : disc.orbits.last_stable()) *
                             std::pow(100, k / 500.0)));
      g.push_back(1.1f);
    }
    std::vector<WorkingRgb> many(r.size());
    light.light(r, g, many);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const WorkingRgb one = light.light(r[k], g[k]);
      if (light.temperature(r[k]) * g[k] > 505) {
        ASSERT_NEAR(many[k].g / one.g, 1, plunging ? 2.5e-4 : 6e-5) << r[k];
      }
    }
  }
}

}  // namespace
}  // namespace domefall
