// Tests of the profile of a disc against the conservation laws that it follows from.
#include "pipeline/sources/disc/disc_light.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstring>
#include <random>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

Disc disc_with(double t_max_k, bool plunging = false) {
  return {
      .inner = plunging ? 2.0 : 6.0, .t_max_k = t_max_k, .luminance = 0.004, .plunging = plunging};
}

double relative(float a, float b, const WorkingRgb& of) {
  return std::abs(a - b) / std::max({of.r, of.g, of.b, 1e-30f});
}

double relative_error(const WorkingRgb& a, const WorkingRgb& b) {
  return std::max({relative(a.r, b.r, b), relative(a.g, b.g, b), relative(a.b, b.b, b)});
}

TEST(DiscDepth, FallsToNothingAtTheHorizonForWhoIsInside) {
  Disc disc = disc_with(1e4, true);
  disc.outer = 20, disc.optical_depth = 3, disc.rim = 0.1;
  EXPECT_EQ(depth_across(disc, 2, 2), 3);
  double before = 3;
  for (const double r : {1.999, 1.9, 1.5, 0.5}) {
    EXPECT_EQ(depth_across(disc, 2, r), 0);
    const double depth = depth_across(disc, 2.1, r);
    EXPECT_LE(depth, before) << r;
    EXPECT_GE(depth, 3 * 0.5) << r;  // at half of the rim
    before = depth;
  }
  EXPECT_NEAR(before, 3 * 0.5, 1e-9);
  EXPECT_EQ(depth_across(disc, 2.3, 0.5), 3);
  EXPECT_EQ(absorbed_part(disc, 2, 1.5, 0.3), 0);
  EXPECT_NEAR(absorbed_part(disc, 2, 2, 0.5), 1 - std::exp(-6), 1e-6);
}

TEST(DiscDepth, IsWholeInTheMiddleOfANarrowDisc) {
  Disc disc = disc_with(1e4);
  disc.inner = 18.5, disc.outer = 20, disc.optical_depth = 3, disc.rim = 0.2;
  EXPECT_EQ(depth_across(disc, 18.5, 30), 0);
  EXPECT_NEAR(depth_across(disc, 18.875, 30), 3 * 0.5, 1e-12);
  EXPECT_NEAR(depth_across(disc, 19.25, 30), 3, 1e-12);
  EXPECT_NEAR(depth_across(disc, 19.625, 30), 3 * 0.5, 1e-12);
  EXPECT_EQ(depth_across(disc, 20, 30), 0);
}

TEST(DiscLight, TheHottestRingHasTheLuminanceOfTheShow) {
  for (const double t : {1500.0, 1e4, 1e7}) {
    for (const bool plunging : {false, true}) {
      const DiscLight light(disc_with(t, plunging));
      const double hottest = PageThorneProfile(plunging).hottest();
      EXPECT_NEAR(light.temperature(hottest), t, 1e-9 * t);
      EXPECT_NEAR(luminance(light.light(hottest, 1)), 0.004, 0.004 * 4e-4) << t;
    }
  }
}

// The integral of Planck's law itself, shifted and dimmed as [Riazuelo] app. app_img says.
TEST(DiscLight, IsABlackbodyOfTheShiftedTemperature) {
  const Disc disc = disc_with(8000);
  const DiscLight light(disc);
  const double scale = disc.luminance / blackbody_xyz(8000).y;
  for (const double r : {6.5, 9.55, 14.0, 20.0}) {
    for (const double g : {0.4, 0.8, 1.0, 1.5}) {
      const Xyz xyz = blackbody_xyz(light.temperature(r) * g);
      const WorkingRgb truth = to_working({xyz.x * scale, xyz.y * scale, xyz.z * scale});
      EXPECT_LT(relative_error(light.light(r, g), truth), 4e-4) << r << " " << g;
    }
  }
}

TEST(DiscLight, OfManyPlacesIsThatOfEach) {
  std::mt19937 random(7);
  const auto between = [&random](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random()) / 4294967296.0);
  };
  for (const bool plunging : {false, true}) {
    for (const double t_max : {1000.0, 1e4, 3e5, 1e9}) {
      const DiscLight light(disc_with(t_max, plunging));
      std::vector<float> r, g;
      for (int k = 0; k < 3001; ++k) {
        r.push_back(static_cast<float>(between(plunging ? 2 : 6.001, 1e4)));
        g.push_back(static_cast<float>(between(0.05, 20)));
      }
      std::vector<WorkingRgb> many(r.size());
      light.light(r, g, many);
      for (std::size_t k = 0; k < r.size(); ++k) {
        const WorkingRgb one = light.light(r[k], g[k]);
        const double seen = light.temperature(r[k]) * g[k];
        // At 500 K the blackbody's table ends.
        if (seen > 505) {
          ASSERT_LT(relative_error(many[k], one), plunging ? 2.5e-4 : 6e-5)
              << r[k] << " " << g[k] << " " << seen;
        }
      }
    }
  }
}

TEST(DiscLight, IsBlackWhereThereIsNoGasAndFiniteWhereItIsTooBright) {
  const std::vector<float> r{1.5f, 2.0f, 4.0f, 6.0f, 9.55f, 9.55f, 9.55f, 1e30f};
  const std::vector<float> g{1.0f, 1.0f, 1.0f, 1.0f, 0.0f, 1e-30f, 1e30f, 1.0f};
  for (const double t_max : {1000.0, 1e9}) {
    const DiscLight light(disc_with(t_max));
    std::vector<WorkingRgb> many(r.size());
    light.light(r, g, many);
    for (std::size_t k = 0; k < r.size(); ++k) {
      for (const WorkingRgb& c : {many[k], light.light(r[k], g[k])}) {
        EXPECT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b)) << k;
        EXPECT_EQ(luminance(c) > 0, k == 6) << k << " " << t_max;
      }
    }
  }
}

TEST(DiscLight, HasTheSameBitsWithEveryInstructionSet) {
  std::vector<float> r, g;
  for (int k = 0; k < 1000; ++k) {
    r.push_back(2 + 0.03f * static_cast<float>(k));
    g.push_back(0.3f + 0.002f * static_cast<float>(k));
  }
  const Simd before = simd_in_use();
  const DiscLight light(disc_with(1e4, true));
  use_simd(Simd::kPortable);
  std::vector<WorkingRgb> plain(r.size()), wide(r.size());
  light.light(r, g, plain);
  for (const Simd level : kEverySimd) {
    if (!processor_has(level)) continue;
    use_simd(level);
    light.light(r, g, wide);
    EXPECT_EQ(std::memcmp(plain.data(), wide.data(), plain.size() * sizeof(WorkingRgb)), 0)
        << name_of(level);
  }
  use_simd(before);
}

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
  // dF/dr vanishes there: a stronger claim than that neighbours are below.
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
