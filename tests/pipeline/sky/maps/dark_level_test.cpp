#include "pipeline/sky/maps/dark_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/colour/blackbody.h"
#include "pipeline/sky/maps/sky_pyramid.h"

namespace domefall {
namespace {

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
