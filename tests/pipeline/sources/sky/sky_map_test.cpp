#include "pipeline/sources/sky/sky_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/cube_face.h"
#include "pipeline/sources/sky/dark_level.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {
namespace {

TEST(SkyTexels, KeepLightToElevenBitsAndHoldNoSubnormals) {
  for (const float value : {1.0f, 1234.5f, 16000.0f, 0.01f, 7e-5f})
    EXPECT_NEAR(half_value(half_bits(value)), value, value * 0x1p-11f);
  EXPECT_EQ(half_bits(6.0e-5f), 0) << "below 2^-14";
  EXPECT_EQ(half_bits(0), 0);
}

TEST(SkyTexels, AUnitPutsTheBrightestNearTheMiddleOfTheUpperHalf) {
  for (const double greatest : {1e-9, 7.72e-4, 1.0, 3e12}) {
    EXPECT_GE(greatest / sky_unit(greatest), 0x1p13);
    EXPECT_LT(greatest / sky_unit(greatest), 0x1p14);
  }
  EXPECT_EQ(sky_unit(0), 1);
}

TEST(CubeFaces, APointAndItsDirectionGoTogether) {
  for (int face = 0; face < 6; ++face)
    for (const double u : {-0.9, -0.2, 0.7})
      for (const double v : {-0.5, 0.3, 0.95}) {
        const FacePoint p = face_of(direction_of({face, u, v}) * 3);
        EXPECT_EQ(p.face, face);
        EXPECT_NEAR(p.u, u, 1e-15);
        EXPECT_NEAR(p.v, v, 1e-15);
      }
}

// A uniform patch of a temperature and a surface brightness gives back both, at every filter.
TEST(ThermalMap, GivesBackTheLuminanceAndTheTemperatureOfAUniformSky) {
  // 22 magnitudes of V per square arcsecond, about a dark sky.
  const double arcsecond = std::numbers::pi / (180 * 3600);
  const double t = 5200, v = 22;
  const double radiance =
      std::pow(10, -0.4 * v) * bolometric_flux_at_v_zero(t) / (arcsecond * arcsecond);
  const double theta = std::log2(t / kThermalBase), unit = sky_unit(radiance * theta);
  const SkyPyramid pyramid(SkyMapKind::kThermal, unit, 8);
  paint(pyramid.levels[0], [&](const V3d&, float* channel) {
    channel[0] = static_cast<float>(radiance / unit);
    channel[1] = static_cast<float>(radiance * theta / unit);
  });
  pyramid.finish();
  const SkyMap map = pyramid.map();
  const WorkingRgb colour = blackbody_colours().per_flux(t);
  const double expected = luminance(colour) * radiance;
  for (const double footprint : {0.0, 0.3, 2.0, 10.0}) {
    const ThermalLight light = map.sample_thermal({0.3, -0.5, 0.7}, footprint);
    EXPECT_NEAR(light.radiance, radiance, radiance * 0x1p-11);
    EXPECT_NEAR(light.temperature, t, t * 4e-3) << "two roundings to 2^-12 of theta = 4.3";
    EXPECT_NEAR(luminance(map.sample({0.3, -0.5, 0.7}, footprint)), expected, 4e-3 * expected);
  }
  // The same from the full surface: a fraction of it that has this radiance.
  const double fraction = radiance / blackbody_radiance(t);
  EXPECT_NEAR(blackbody_xyz(t).y * fraction, expected, 1e-3 * expected);
}

TEST(ThermalMap, IsDarkWhereThereIsNoLight) {
  const SkyPyramid pyramid(SkyMapKind::kThermal, 1, 4);
  const SkyMap map = pyramid.map();
  EXPECT_EQ(map.sample_thermal({1, 0, 0}, 0).radiance, 0);
  EXPECT_EQ(luminance(map.sample({1, 0, 0}, 0)), 0);
}

// A colour map with a cap of 0.25 about an axis, which takes a part (1 - cos(angle))/2 of the
// sphere, in a wider cap of 0.5, in 1.
SkyMap capped(double part, const V3d& axis, int size) {
  const double edge = 1 - 2 * part;
  const SkyPyramid pyramid(SkyMapKind::kColour, sky_unit(1), size);
  paint(
      pyramid.levels[0],
      [&](const V3d& d, float* channel) {
        const double x = d.normalized().dot(axis), grey = x > edge ? 0.25 : x > 0.4 ? 0.5 : 1;
        for (int k = 0; k < 3; ++k) channel[k] = static_cast<float>(grey / pyramid.unit);
      },
      4);
  pyramid.finish();
  return pyramid.map();
}

// A cap in the middle of a face and one at the corner of three faces, whose texels are seen under a
// fifth of the solid angle of those in the middle.  The edge is washed out by the size of a texel.
TEST(DarkLevel, IsTheLightThatOnePerCentOfTheSphereFallsBelow) {
  for (const V3d& axis : {V3d(1, 0, 0), V3d(1, 1, 1).normalized()}) {
    const DarkLevel dark = dark_level(capped(0.012, axis, 64));
    EXPECT_NEAR(dark.light, 0.25, 1e-3) << axis;
    EXPECT_NEAR(dark.luminance, 0.25, 1e-3) << axis;
    EXPECT_NEAR(dark_level(capped(0.008, axis, 64)).light, 0.5, 0.05) << axis;
  }
}

TEST(DarkLevel, IsNoneOfAnEvenSky) {
  const auto level = [](double darkest) {
    const SkyPyramid pyramid(SkyMapKind::kColour, sky_unit(1), 16);
    paint(pyramid.levels[0], [&](const V3d& d, float* channel) {
      const double grey = d.x > 0.9 * d.length() ? darkest : 1;
      for (int k = 0; k < 3; ++k) channel[k] = static_cast<float>(grey / pyramid.unit);
    });
    pyramid.finish();
    return dark_level(pyramid.map()).light;
  };
  EXPECT_EQ(level(1), 0);
  EXPECT_EQ(level(0.8), 0);
  EXPECT_NEAR(level(0.7), 0.7, 1e-3);
}

TEST(DarkLevel, DoesNotDependOnLevelsFinerThanThoseItIsMeasuredOn) {
  const SkyMap fine = capped(0.02, V3d(1, 0, 0), 256);
  EXPECT_EQ(dark_level(fine).light, dark_level(fine.without_levels_above(64)).light);
}

TEST(DarkLevel, OfAThermalMapIsARadianceAndTheLuminanceThatBelongsToIt) {
  constexpr double kTemperature = 4000, kRadiance = 2e-5;
  const double theta = std::log2(kTemperature / kThermalBase);
  const SkyPyramid pyramid(SkyMapKind::kThermal, sky_unit(4 * kRadiance * theta), 8);
  paint(pyramid.levels[0], [&](const V3d& d, float* channel) {
    const double radiance = d.x > 0.9 * d.length() ? kRadiance : 4 * kRadiance;
    channel[0] = static_cast<float>(radiance / pyramid.unit);
    channel[1] = static_cast<float>(radiance * theta / pyramid.unit);
  });
  pyramid.finish();
  const SkyMap map = pyramid.map();
  const double efficacy = blackbody_xyz(kTemperature).y / blackbody_radiance(kTemperature);  // lm/W
  const DarkLevel dark = dark_level(map);
  EXPECT_NEAR(dark.light, kRadiance, 1e-3 * kRadiance);
  // Half floats hold the temperature to 0.3 %, which enters about five times.
  EXPECT_NEAR(dark.luminance, efficacy * kRadiance, 0.015 * efficacy * kRadiance);
  EXPECT_NEAR(light_per_luminance(map), 1 / efficacy, 0.015 / efficacy);
}

TEST(DarkLevel, OfAColourMapIsItsLuminanceAlready) {
  EXPECT_EQ(light_per_luminance(capped(0.02, V3d(1, 0, 0), 8)), 1);
}

}  // namespace
}  // namespace domefall
