#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "pipeline/image/errors.h"
#include "pipeline/image/read_image.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/catalogue/star_catalogue.h"
#include "pipeline/sky/grid_sky.h"
#include "pipeline/sky/make/panorama.h"
#include "pipeline/sky/maps/sky_map.h"

namespace domefall {
namespace {

using std::numbers::pi;

SkyDirection at(double ra_deg, double dec_deg) {
  const double ra = ra_deg * pi / 180, dec = dec_deg * pi / 180;
  return {{std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)}};
}

const std::string kAssets = DOMEFALL_SOURCE_DIR "/shows/assets/";

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
  EXPECT_GT(luminance_of(map.sample(at(0, 0).v, 0)), 0.9 * kPanoramaUnit);
  EXPECT_GT(luminance_of(map.sample(at(90, 45).v, 0)), 0.9 * kPanoramaUnit);
  EXPECT_EQ(luminance_of(map.sample(at(270, 45).v, 0)), 0);
  EXPECT_EQ(luminance_of(map.sample(at(90, -45).v, 0)), 0);
}

// No seam at RA 12h, none between the cube's faces, no pinch at the poles: everywhere the value of
// the function that was painted, to what half a pixel of it changes.
TEST(SkyMap, HasNoSeamAndNoPole) {
  FloatImage image(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const double ra = 180 - (x + 0.5) * 360 / 512, dec = 90 - (y + 0.5) * 180 / 256;
      for (int c = 0; c < 3; ++c)
        image.row(y)[3 * x + c] = static_cast<float>(smooth_sky(at(ra, dec).v));
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

TEST(MilkyWay, HasItsCloudsWhereTheSkyHasThem) {
  const SkyMap map = map_of_panorama(read_image(kAssets + "milky_way.exr"));
  const auto light = [&map](double ra, double dec) {
    return luminance_of(map.sample(at(ra, dec).v, 0.02)) / kPanoramaUnit;
  };
  const double sagittarius_cloud = light(271, -29), eta_carinae = light(161.3, -59.7),
               large_cloud = light(80.9, -69.8), galactic_pole = light(192.9, 27.1),
               coalsack = light(192.5, -62.9), beside_coalsack = light(187, -63);
  EXPECT_GT(sagittarius_cloud, 2);
  EXPECT_LT(sagittarius_cloud, 6);
  EXPECT_GT(eta_carinae, 1);
  EXPECT_LT(coalsack, beside_coalsack);
  EXPECT_GT(large_cloud, 1.5 * light(100, -80));
  // 30 S10(V), as measured skies have it, are 0.25.
  EXPECT_LT(galactic_pole, 0.3);
  EXPECT_GT(galactic_pole, 0.15);
}

TEST(Grid, IsTheChequerboardOfThePaperWithItsPolarDiscs) {
  const auto y = [](double ra, double dec) {
    return static_cast<double>(luminance(grid_light(at(ra, dec), 0, 1)));
  };
  const double light = std::max(y(2.5, 2.5), y(7.5, 2.5)),
               dark = std::min(y(2.5, 2.5), y(7.5, 2.5));
  EXPECT_NEAR(light / dark, 4, 1e-3);
  for (int i = 0; i < 72; ++i)
    for (int j = -17; j < 17; ++j) {
      const bool same = (i + j) % 2 == 0;
      EXPECT_NEAR(y(5 * i + 2.5, 5 * j + 2.5), same ? y(2.5, 2.5) : y(7.5, 2.5), 1e-3 * light);
    }
  EXPECT_NEAR(y(10, 88), y(200, -88), 1e-9);
  EXPECT_GT(y(10, 88), light);
  const WorkingRgb pole = grid_light(at(0, 89), 0, 1), square = grid_light(at(2.5, 2.5), 0, 1);
  EXPECT_GT(pole.r / pole.b, 3 * square.r / square.b) << "2000 K against 8000 K";
}

TEST(Grid, BlurredByItsFootprintKeepsItsMean) {
  const double sharp_light = luminance(grid_light(at(2.5, 2.5), 0, 1)),
               sharp_dark = luminance(grid_light(at(7.5, 2.5), 0, 1));
  for (const double footprint : {0.8, 10.0})
    EXPECT_NEAR(luminance(grid_light(at(33, 21), footprint, 1)), (sharp_light + sharp_dark) / 2,
                0.02 * sharp_light);
}

TEST(Stars, AreTheNakedEyeSky) {
  const StarCatalogue catalogue = read_star_catalogue(kAssets + "naked_eye_stars.csv", 6.5);
  EXPECT_EQ(catalogue.stars.size(), 8874u);
  EXPECT_TRUE(
      std::is_sorted(catalogue.stars.begin(), catalogue.stars.end(),
                     [](const Star& a, const Star& b) { return a.v_magnitude < b.v_magnitude; }));
  for (const auto& [name, ra, dec] :
       {std::tuple("Sirius", 101.287155, -16.716116), std::tuple("vega", 279.234735, 38.783689),
        std::tuple("alpha Ori", 88.792939, 7.407064)}) {
    const auto found = find_star(catalogue, name);
    ASSERT_TRUE(found) << name;
    EXPECT_LT((found->v - at(ra, dec).v).length(), 3e-6) << "0.5 arcsec";
  }
  EXPECT_EQ(read_star_catalogue(kAssets + "naked_eye_stars.csv", 1.5).stars.size(), 23u);
  EXPECT_EQ(nearest_star_name(catalogue, "Betelguese"), "Betelgeuse");
}

TEST(Stars, ADamagedRowIsNamedByFileAndLine) {
  const auto file = std::filesystem::temp_directory_path() / "domefall_damaged_catalogue.csv";
  std::ofstream(file) << "ra_deg,dec_deg,v_mag,b_v,name,designation\n1,2,3,0.5,,\n1,200,3,0.5,,\n";
  try {
    read_star_catalogue(file, 6.5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ":3")) << error.what();
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace domefall
