#include "pipeline/sky/make/panorama.h"

#include <gtest/gtest.h>

#include <random>

#include "pipeline/image/read_image.h"
#include "tests/source_tree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

double luminance_of(const WorkingRgb& c) { return luminance(c); }

// A smooth sky, the same function in the image and in space.
double smooth_sky(const V3d& d) { return 2 + d.x + 0.5 * d.y * d.z - 0.7 * d.z; }

TEST(SkyMap, RightAscensionGrowsToTheLeftFromTheMiddleAndNorthIsUp) {
  FloatImage image(256, 128);
  const auto paint = [&image](int x, int y) {
    for (int c = 0; c < 3; ++c) image.row(y)[3 * x + c] = 1;
  };
  paint(127, 63), paint(128, 63), paint(127, 64), paint(128, 64);  // RA 0h, Dec 0
  paint(63, 31), paint(64, 31), paint(63, 32), paint(64, 32);      // RA 6h, Dec +45
  const SkyMap map = map_of_panorama(image);
  EXPECT_GT(luminance_of(map.sample(sky_direction(0, 0).v, 0)), 0.9 * kPanoramaUnit);
  EXPECT_GT(luminance_of(map.sample(sky_direction(90, 45).v, 0)), 0.9 * kPanoramaUnit);
  EXPECT_EQ(luminance_of(map.sample(sky_direction(270, 45).v, 0)), 0);
  EXPECT_EQ(luminance_of(map.sample(sky_direction(90, -45).v, 0)), 0);
}

// No seam at RA 12h, none between the cube's faces, no pinch at the poles: everywhere the value of
// the function that was painted, to what half a pixel of it changes.
TEST(SkyMap, HasNoSeamAndNoPole) {
  FloatImage image(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const double ra = 180 - (x + 0.5) * 360 / 512, dec = 90 - (y + 0.5) * 180 / 256;
      for (int c = 0; c < 3; ++c)
        image.row(y)[3 * x + c] = static_cast<float>(smooth_sky(sky_direction(ra, dec).v));
    }
  const SkyMap map = map_of_panorama(image);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<V3d> directions{{0, 0, 1},  {0, 0, -1}, {-1, 0, 0},    {-1, 1e-9, 0},
                              {1, 1, 1},  {1, 1, 0},  {-1, -1, 1},   {-1, 1, -1},
                              {0, 1, -1}, {-1, 0, 1}, {1, 0, 1.001}, {1, 0, 0.999}};
  for (int k = 0; k < 5000; ++k)
    directions.emplace_back(normal(random), normal(random), normal(random));
  for (const V3d& raw : directions) {
    const V3d d = raw.normalized();
    for (const double footprint : {0.0, 0.02, 0.05}) {
      const double seen = luminance_of(map.sample(d, footprint)) / kPanoramaUnit;
      EXPECT_NEAR(seen, smooth_sky(d), 2e-3 + footprint) << d << " " << footprint;
    }
  }
}

// Filtered over some degrees, a map of means is the map that they were taken from.
TEST(MilkyWay, IsTheSameFromAfarWhereItsFineLevelsAreLeftOut) {
  const FloatImage image = read_image(source_file("shows/assets/milky_way_deep.exr"));
  const SkyMap whole = map_of_panorama(image), coarse = map_of_panorama(image, 64);
  EXPECT_EQ(whole.levels().front().size, 1024);
  EXPECT_EQ(coarse.levels().front().size, 64);
  for (double ra = 5; ra < 360; ra += 40)
    for (double dec = -85; dec < 90; dec += 17) {
      const V3d d = sky_direction(ra, dec).v;
      const double light = luminance_of(whole.sample(d, 0.1));
      // The most is beside the Large Magellanic Cloud, whose bar is brighter than all around.
      EXPECT_NEAR(luminance_of(coarse.sample(d, 0.1)), light, 0.15 * light) << ra << " " << dec;
    }
}

TEST(MilkyWay, HasItsCloudsWhereTheSkyHasThem) {
  const SkyMap map = map_of_panorama(read_image(source_file("shows/assets/milky_way.exr")), 512);
  const auto light = [&map](double ra, double dec) {
    return luminance_of(map.sample(sky_direction(ra, dec).v, 0.02)) / kPanoramaUnit;
  };
  const double sagittarius_cloud = light(271, -29), eta_carinae = light(161.3, -59.7),
               large_cloud = light(80.9, -69.8), galactic_pole = light(192.9, 27.1),
               coalsack = light(192.5, -62.9), beside_coalsack = light(187, -63);
  EXPECT_GT(sagittarius_cloud, 2);
  EXPECT_LT(sagittarius_cloud, 6);
  EXPECT_GT(eta_carinae, 1);
  EXPECT_LT(coalsack, beside_coalsack);
  EXPECT_GT(large_cloud, 1.5 * light(100, -80));
  // Measured skies have 30 S10(V), of which the stars of V = 6.5 to 9 are 11, which are drawn as
  // stars.  The rest is 0.16.
  EXPECT_LT(galactic_pole, 0.2);
  EXPECT_GT(galactic_pole, 0.13);
}

}  // namespace
}  // namespace domefall
