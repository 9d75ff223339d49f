#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "pipeline/render/scene/sky_light.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {
namespace {

// Half of every patch of this sky shines like the surface of a star of 4000 K.
constexpr double kSkyTemperature = 4000, kPart = 0.5;

Sky even_sky() {
  const double radiance = kPart * blackbody_radiance(kSkyTemperature);
  const double theta = std::log2(kSkyTemperature / kThermalBase);
  const SkyPyramid pyramid(SkyMapKind::kThermal, sky_unit(radiance * theta), 4);
  paint(pyramid.levels[0], [&](const V3d&, float* channel) {
    channel[0] = static_cast<float>(radiance / pyramid.unit);
    channel[1] = static_cast<float>(radiance * theta / pyramid.unit);
  });
  pyramid.finish();
  Sky sky;
  sky.background = std::make_shared<const SkyMap>(pyramid.map());
  return sky;
}

WorkingRgb seen(const Show& show, double g) {
  const Sky sky = even_sky();
  return SkyLight(sky, show.effects, show.panorama_shift, 1).at({0.2, -0.4, 0.9}, 0.1, g);
}

// A blackbody of temperature T at frequency ratio g is seen as one of g T, in colour and in
// brightness.  The expected light is integrated over the spectrum without the renderer's tables.
TEST(ThermalSky, IsSeenAtGTimesItsTemperature) {
  const Show show;
  for (const double g : {0.3, 0.7, 1.0, 1.6, 5.0, 40.0}) {
    const WorkingRgb light = seen(show, g);
    const Xyz surface = blackbody_xyz(g * kSkyTemperature);
    const WorkingRgb expected = to_working(surface);
    // The map stores the temperature as half floats, to 0.3 %.  In Wien's tail a relative error of
    // T enters the light multiplied by about 25000 K/(g T).
    const double steep = 0.003 * (4 + 25000 / (g * kSkyTemperature));
    EXPECT_NEAR(luminance(light), kPart * surface.y, steep * kPart * surface.y) << g;
    EXPECT_NEAR(light.b / light.r, expected.b / expected.r, 2 * steep * expected.b / expected.r)
        << g;
  }
}

TEST(ThermalSky, IsDarkInTheInfraredAndFiniteFarInTheBlue) {
  const Show show;
  EXPECT_EQ(luminance(seen(show, 0.1)), 0);
  for (const double g : {1e4, 1e9, 1e14}) {
    const double light = luminance(seen(show, g));
    EXPECT_TRUE(std::isfinite(light)) << g;
    EXPECT_GT(light, luminance(seen(show, 1))) << g;
  }
}

TEST(ThermalSky, ShiftsOnlyWhatTheShowKeeps) {
  Show still;
  still.effects.doppler_colour = false;
  still.effects.intensity = false;
  const double at_rest = luminance(seen(still, 1));
  EXPECT_NEAR(luminance(seen(still, 3)), at_rest, 1e-6 * at_rest);
  Show bright = still;
  bright.effects.intensity = true;
  EXPECT_NEAR(luminance(seen(bright, 3)), 81 * at_rest, 1e-4 * at_rest);
}

}  // namespace
}  // namespace domefall
