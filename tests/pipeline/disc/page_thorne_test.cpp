// Tests of the profile of a disc against the conservation laws that it follows from.
#include "pipeline/disc/page_thorne.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace domefall {
namespace {

// Circular orbits: energy, angular momentum and angular velocity.
double energy(double r) { return (1 - 2 / r) / std::sqrt(1 - 3 / r); }
double momentum(double r) { return std::sqrt(r) / std::sqrt(1 - 3 / r); }
double omega(double r) { return std::pow(r, -1.5); }
double slope(double (*f)(double), double r) {
  const double h = 1e-4 * r;
  return (8 * (f(r + h) - f(r - h)) - (f(r + 2 * h) - f(r - 2 * h))) / (12 * h);
}

// [Page & Thorne 1974] eqs. 11b and 12 as they stand, by quadrature: what gas loses of its energy
// and its angular momentum on its way inwards leaves the disc, by its faces or along it.  `pull` is
// the torque at the last stable orbit over the angular momentum that the gas brings there.
double flux_of_conservation(double r, double pull) {
  const auto lost = [](double x) {
    return (energy(x) - omega(x) * momentum(x)) * slope(momentum, x);
  };
  const double brought =
      r > 6 ? boost::math::quadrature::gauss_kronrod<double, 31>::integrate(lost, 6, r, 10, 1e-12)
            : 0;
  const double pulled = (energy(6) - omega(6) * momentum(6)) * momentum(6) * pull;
  const double free = energy(r) - omega(r) * momentum(r);
  return -slope(omega, r) / (r * free * free) * (brought + pulled);
}

TEST(PageThorne, FollowsFromTheConservationLaws) {
  const PageThorneProfile profile(false);
  const double greatest = flux_of_conservation(profile.hottest(), 0);
  for (const double r : {6.5, 7.0, 8.0, 9.55, 12.0, 20.0, 50.0, 1000.0})
    EXPECT_NEAR(profile.flux(r) / (flux_of_conservation(r, 0) / greatest), 1, 1e-8) << r;
}

TEST(PageThorne, GasThatPlungesPullsAtTheLastStableOrbit) {
  const PageThorneProfile profile(true);
  EXPECT_EQ(profile.hottest(), 6);
  const double greatest = flux_of_conservation(6, 0.02);
  for (const double r : {6.0, 6.01, 7.0, 9.55, 20.0, 1000.0})
    EXPECT_NEAR(profile.flux(r) / (flux_of_conservation(r, 0.02) / greatest), 1, 1e-8) << r;
}

TEST(PageThorne, IsHottestAt955) {
  const PageThorneProfile profile(false);
  EXPECT_NEAR(profile.hottest(), 9.55, 0.002);
  EXPECT_EQ(profile.flux(profile.hottest()), 1);
  for (const double r : {9.4, 9.5, 9.6, 9.7}) EXPECT_LT(profile.flux(r), 1);
}

// dF/dr vanishes there: a stronger claim than that neighbours are below.
TEST(PageThorne, HasItsMaximumWhereTheSlopeVanishes) {
  const PageThorneProfile profile(false);
  const double r = profile.hottest(), h = 1e-3;
  const double down = 1 - profile.flux(r - h), up = 1 - profile.flux(r + h);
  EXPECT_NEAR(down / up, 1, 2e-3);
}

// B = (r - 6)^2/(12 sqrt 6) and F = B/(3 * 36 sqrt 6) to first order; the next order is 1.5 (r -
// 6).
TEST(PageThorne, KeepsItsDigitsNextToTheLastStableOrbit) {
  const PageThorneProfile profile(false);
  const double unit = profile.flux(6 + 1e-3) / 1e-6;
  for (const double above : {0x1p-12, 0x1p-20, 0x1p-30, 0x1p-40})
    EXPECT_NEAR(profile.flux(6 + above) / (above * above) / unit, 1, 2e-3) << above;
  const double near = 0x1p-40, nearer = 0x1p-41;
  EXPECT_NEAR(profile.flux(6 + near) / profile.flux(6 + nearer), 4, 1e-11);
  EXPECT_EQ(profile.flux(6), 0);
}

TEST(PageThorne, FarOutItFallsWithTheCubeOfTheRadius) {
  const PageThorneProfile profile(false);
  EXPECT_NEAR(profile.flux(1e12) / profile.flux(2e12), 8, 1e-4);
  EXPECT_NEAR(profile.temperature(1e12) / profile.temperature(2e12), std::pow(2, 0.75), 1e-5);
}

TEST(PageThorne, InsideTheLastStableOrbitThereIsLightOnlyOfGasThatPlunges) {
  const PageThorneProfile stable(false), plunging(true);
  for (const double r : {2.0, 3.0, 5.0, 5.999}) {
    EXPECT_EQ(stable.flux(r), 0);
    EXPECT_GT(plunging.flux(r), 0.9);
  }
  EXPECT_EQ(plunging.flux(1.999), 0);
  EXPECT_NEAR(plunging.flux(std::nextafter(6, 0)), plunging.flux(6), 1e-9);
  // [Mummery & Balbus 2023]: T ~ (6/r)^(17/28) u^(-1/28), u from 0.01 to 1 + 0.01 of 2 sqrt 2.
  EXPECT_NEAR(plunging.temperature(2),
              std::pow(3, 17.0 / 28) * std::pow(1 + 2 * std::sqrt(2) / 0.01, -1.0 / 28), 1e-12);
}

}  // namespace
}  // namespace domefall
