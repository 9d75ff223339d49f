#include "pipeline/disc/disc_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "pipeline/colour/blackbody.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

Disc disc_with(double t_max_k, bool plunging = false) {
  Disc disc;
  disc.inner = plunging ? 2 : 6;
  disc.t_max_k = t_max_k;
  disc.plunging = plunging;
  disc.luminance = 0.004;
  return disc;
}

double relative(float a, float b, const WorkingRgb& of) {
  return std::abs(a - b) / std::max({of.r, of.g, of.b, 1e-30f});
}

double relative_error(const WorkingRgb& a, const WorkingRgb& b) {
  return std::max({relative(a.r, b.r, b), relative(a.g, b.g, b), relative(a.b, b.b, b)});
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

}  // namespace
}  // namespace domefall
