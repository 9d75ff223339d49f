#include "pipeline/sources/sky/starlight_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/cube_face.h"

namespace domefall {
namespace {

using std::numbers::pi;

StarlightMap light_of(const std::vector<FaintStar>& stars, double blur, int size) {
  StarlightMap light(size);
  light.add(stars, blur);
  return light;
}

SkyMap map_of(const std::vector<FaintStar>& stars, double blur, int size, double gain = 1) {
  const StarlightMap light = light_of(stars, blur, size);
  const SkyPyramid pyramid(SkyMapKind::kThermal, sky_unit(gain * light.greatest()), size);
  light.write(pyramid, gain);
  pyramid.finish();
  return pyramid.map();
}

// Independent of how the map was made: the mean of samples in equal areas of (longitude, sine of
// latitude).
double flux_of(const SkyMap& map) {
  constexpr int kRows = 600, kColumns = 1200;
  double sum = 0;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const double z = (j + 0.5) / kRows * 2 - 1, a = (i + 0.5) / kColumns * 2 * pi;
      const double s = std::sqrt(1 - z * z);
      sum += map.sample_thermal({s * std::cos(a), s * std::sin(a), z}, 0).radiance;
    }
  return sum * 4 * pi / kRows / kColumns;
}

std::vector<FaintStar> random_stars(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<FaintStar> stars;
  for (int k = 0; k < count; ++k) {
    const V3d d = V3d(normal(random), normal(random), normal(random)).normalized();
    stars.push_back({d, 1e-12 * std::exp(3 * uniform(random)), 3000 + 9000 * uniform(random), 9});
  }
  return stars;
}

TEST(Starlight, TheLightOfTheMapIsThatOfTheStars) {
  const std::vector<FaintStar> stars = random_stars(3000);
  double total = 0;
  for (const FaintStar& s : stars) total += s.flux;
  EXPECT_NEAR(light_of(stars, 0.03, 128).flux(), total, 1e-4 * total);
  EXPECT_NEAR(flux_of(map_of(stars, 0.03, 128)), total, 1e-3 * total);
  EXPECT_NEAR(flux_of(map_of(stars, 0.03, 128, 2.5)), 2.5 * total, 2.5e-3 * total);
}

// At a corner, on an edge and in the middle of a face: the same round Gaussian of the same height.
// The nearest texels are up to 0.18 sigma away, where a sample between them is 1.7 % less.
TEST(Starlight, AStarIsAsRoundAndAsBrightAnywhereOnTheCube) {
  const double blur = 0.03, flux = 1e-10;
  for (const V3d& raw : {V3d(1, 0, 0), V3d(1, 1, 1), V3d(-1, 1, 0), V3d(0.3, -1, 0.98)}) {
    const V3d d = raw.normalized();
    const SkyMap map = map_of({{d, flux, 5000, 9}}, blur, 256);
    const V3d aside = d.cross(V3d(0.1, 0.2, 0.9)).normalized(), across = d.cross(aside);
    const double peak = map.sample_thermal(d, 0).radiance;
    // The Gaussian less its value at 4 sigma, which takes the factor away from its integral.
    const double end = std::exp(-8), kept = 1 - 9 * end;
    EXPECT_NEAR(peak, flux * (1 - end) / (2 * pi * blur * blur * kept), 0.02 * peak) << raw;
    for (const double sigmas : {1.0, 2.0})
      for (int k = 0; k < 12; ++k) {
        const double turn = k * pi / 6;
        const V3d at = std::cos(sigmas * blur) * d +
                       std::sin(sigmas * blur) * (std::cos(turn) * aside + std::sin(turn) * across);
        EXPECT_NEAR(map.sample_thermal(at, 0).radiance / peak, std::exp(-sigmas * sigmas / 2), 0.02)
            << raw << " " << sigmas << " " << k;
      }
  }
}

TEST(Starlight, APatchHasTheColourAndTheLightOfItsStars) {
  // A dense field of stars of one kind: an even glow.  Each is flux per square of 0.002 radians.
  const double t = 4200, v = 10;
  std::vector<FaintStar> stars;
  for (int j = -100; j <= 100; ++j)
    for (int i = -100; i <= 100; ++i)
      stars.push_back({V3d(1, 0.002 * i, 0.002 * j).normalized(),
                       std::pow(10, -0.4 * v) * bolometric_flux_at_v_zero(t), t, v});
  const SkyMap map = map_of(stars, 0.02, 256);
  const ThermalLight light = map.sample_thermal({1, 0, 0}, 0);
  const double radiance = stars[0].flux / (0.002 * 0.002);
  EXPECT_NEAR(light.temperature, t, 4e-3 * t);
  EXPECT_NEAR(light.radiance, radiance, 5e-3 * radiance);
  const WorkingRgb seen = map.sample({1, 0, 0}, 0), star = blackbody_colours().per_flux(t);
  EXPECT_NEAR(seen.r / seen.b, star.r / star.b, 0.01 * star.r / star.b);
  EXPECT_NEAR(luminance(seen), luminance(star) * radiance, 0.01 * luminance(seen));
}

TEST(Starlight, OfTwoKindsOfStarsIsTheirMeanLogTemperature) {
  const V3d d(0, 0, 1);
  const SkyMap map = map_of({{d, 3e-10, 3000, 8}, {d, 1e-10, 12000, 9}}, 0.05, 128);
  EXPECT_NEAR(map.sample_thermal(d, 0).temperature, 3000 * std::sqrt(2), 4e-3 * 3000);
}

TEST(Starlight, KeepsTheStarsBelowTheLimitOnly) {
  StarCatalogue catalogue;
  for (const float v : {1.0f, 6.4f, 6.5f, 6.6f, 9.0f})
    catalogue.stars.push_back({{{1, 0, 0}}, v, 5800});
  const auto stars = fainter_stars(catalogue, 6.5);
  ASSERT_EQ(stars.size(), 2u);
  EXPECT_NEAR(stars[0].flux / stars[1].flux, std::pow(10, 0.4 * 2.4), 1e-4);
}

TEST(Starlight, BrightStarsAreSpreadUntilNoneStandsOut) {
  std::vector<FaintStar> stars;
  for (const double v : {5.0, 6.0, 7.5, 9.0, 10.0, 11.5})
    stars.push_back({{1, 0, 0}, std::pow(10, -0.4 * v), 5800, v});
  std::size_t count = 0;
  for (const BlurClass& spread : blur_classes(stars, 0.01, 9.5)) {
    EXPECT_LE(spread.blur, kWidestBlur);
    count += spread.stars.size();
    for (const FaintStar& star : spread.stars) {
      const double peak = star.flux / (spread.blur * spread.blur);
      const double limit = std::pow(10, -0.4 * 9.5) / (0.01 * 0.01);
      EXPECT_LT(peak, 1.51 * limit) << "half a step of 1.5, squared; V " << star.v_magnitude;
      if (star.v_magnitude < 9.5) {
        EXPECT_GT(peak, limit / 1.51) << star.v_magnitude;
      }
    }
  }
  EXPECT_EQ(count, stars.size());
}

TEST(Starlight, TheTexelsOfACubeMakeASphere) {
  double sum = 0;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i)
      sum += 6 * texel_solid_angle(64, (2 * i + 1) / 64.0 - 1, (2 * j + 1) / 64.0 - 1);
  EXPECT_NEAR(sum, 4 * pi, 1e-4 * 4 * pi);
}

}  // namespace
}  // namespace domefall
