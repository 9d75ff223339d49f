#include "pipeline/sources/sky/sky_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/panorama.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using std::numbers::pi;

const std::string kMapFolder = source_file("shows/assets/");

const StarCatalogue& stars() {
  static const StarCatalogue catalogue = read_star_catalogue(kMapFolder + "stars_to_9.stars", 6.5);
  return catalogue;
}

// A panorama that lies as `o` says and shows the stars as points on a dim ground.
LightImage panorama_of_stars(const Orientation& o) {
  LightImage image{{1024, 512}, 1};
  std::fill(image.pixels.pixels.begin(), image.pixels.pixels.end(), Imath::half(0.01f));
  const M33d panorama = panorama_from_equatorial(o);
  for (const Star& star : stars().stars) {
    if (star.v_magnitude > 5) break;
    const V3d d = apply(panorama, star.direction.v);
    const int x = static_cast<int>((0.5 - std::atan2(d.y, d.x) / (2 * pi)) * 1024) & 1023;
    const int y = std::min(static_cast<int>((0.5 - std::asin(d.z) / pi) * 512), 511);
    for (int c = 0; c < 3; ++c) image.pixels.row(y)[3 * x + c] = 1;
  }
  return image;
}

SkyMap import_as(const LightImage& image, const Orientation& o, int size) {
  const SkyPyramid pyramid(SkyMapKind::kColour, panorama_unit(image, 1e-4), size);
  paint_panorama(image, o, 1e-4, pyramid);
  pyramid.finish();
  return pyramid.map();
}

TEST(Orientations, TurnTheSkyIntoThePanorama) {
  const auto near = [](const V3d& a, const V3d& b) { return (a - b).length() < 1e-6; };
  const V3d middle(1, 0, 0), left(0, 1, 0), top(0, 0, 1);
  Orientation o;
  o.centre_deg = 270;
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), sky_direction(270, 0).v), middle));
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), sky_direction(0, 0).v), left));
  o.longitude_right = true;
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), sky_direction(180, 0).v), left));
  o.south_up = true;
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), sky_direction(0, -90).v), top));
  const M33d galactic = panorama_from_equatorial({SkyFrame::kGalactic, false, false, 0});
  // The galactic centre and the north galactic pole (J2000).
  EXPECT_TRUE((apply(galactic, sky_direction(266.40500, -28.93617).v) - middle).length() < 1e-5);
  EXPECT_TRUE((apply(galactic, sky_direction(192.85948, 27.12825).v) - top).length() < 1e-5);
}

TEST(SkyChecks, APanoramaOfStarsTellsItsOrientation) {
  const Orientation truth{SkyFrame::kGalactic, true, false, 90};
  const LightImage image = panorama_of_stars(truth);
  const SkyCheck right = check_orientation(import_as(image, truth, 512), truth, stars());
  EXPECT_EQ(right.verdict, SkyVerdict::kAgrees);
  EXPECT_TRUE(right.by_stars);
  EXPECT_GT(right.stated.stars, 0.9);
  EXPECT_LT(right.others[0].stars, 0.6);
  const Orientation wrong{SkyFrame::kEquatorial, false, true, 270};
  const SkyCheck other = check_orientation(import_as(image, wrong, 512), wrong, stars());
  EXPECT_EQ(other.verdict, SkyVerdict::kOther);
  EXPECT_EQ(other.others[0].orientation, truth) << orientation_phrase(other.others[0].orientation);
}

// The shipped sky has no stars: its Milky Way has to tell.
TEST(SkyChecks, AStarlessMilkyWayTellsItsOrientation) {
  const FloatImage whole = read_image(kMapFolder + "milky_way_deep.exr").pixels;
  LightImage image{{whole.width / 4, whole.height / 4}, 1};
  for (int y = 0; y < image.pixels.height; ++y)
    for (int x = 0; x < 3 * image.pixels.width; ++x)
      image.pixels.row(y)[x] = whole.row(4 * y)[12 * (x / 3) + x % 3];
  const SkyCheck right = check_orientation(import_as(image, {}, 128), {}, stars());
  EXPECT_EQ(right.verdict, SkyVerdict::kAgrees);
  EXPECT_FALSE(right.by_stars);
  for (const Orientation& wrong : {Orientation{SkyFrame::kEquatorial, true, false, 0},
                                   Orientation{SkyFrame::kEquatorial, false, true, 0},
                                   Orientation{SkyFrame::kEquatorial, false, false, 180},
                                   Orientation{SkyFrame::kGalactic, false, false, 0}}) {
    const SkyCheck other = check_orientation(import_as(image, wrong, 128), wrong, stars());
    EXPECT_EQ(other.verdict, SkyVerdict::kOther) << orientation_phrase(wrong);
    EXPECT_EQ(other.others[0].orientation, Orientation{})
        << orientation_phrase(other.others[0].orientation);
  }
}

// A band along the middle row is much the same mirrored or upside down: what differs are its
// clouds.
TEST(SkyChecks, AMilkyWayAlongTheEquatorTellsItsOrientationToo) {
  const SkyMap sky = map_of_panorama(read_image(kMapFolder + "milky_way_deep.exr").pixels);
  const Orientation truth{SkyFrame::kGalactic, false, false, 0};
  const M33d panorama = panorama_from_equatorial(truth);
  LightImage image{{512, 256}, kPanoramaUnit};
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const V3d d = apply_transposed(
          panorama, sky_direction(180 - (x + 0.5) * 360 / 512, 90 - (y + 0.5) * 180 / 256).v);
      const double light = luminance(sky.sample(d, 0.01)) / kPanoramaUnit;
      for (int c = 0; c < 3; ++c) image.pixels.row(y)[3 * x + c] = static_cast<float>(light);
    }
  for (const Orientation& said : {truth, Orientation{SkyFrame::kGalactic, true, false, 0},
                                  Orientation{SkyFrame::kGalactic, false, true, 0},
                                  Orientation{SkyFrame::kGalactic, false, false, 180},
                                  Orientation{SkyFrame::kEquatorial, false, false, 0}}) {
    const SkyCheck check = check_orientation(import_as(image, said, 128), said, stars());
    EXPECT_FALSE(check.by_stars);
    EXPECT_EQ(check.verdict, said == truth ? SkyVerdict::kAgrees : SkyVerdict::kOther);
    const OrientationFit& best = said == truth ? check.stated : check.others[0];
    EXPECT_EQ(best.orientation, truth)
        << orientation_phrase(said) << " became " << orientation_phrase(best.orientation);
    EXPECT_GT(best.band, 0.8);
    EXPECT_GT(best.clouds, 0.8);
  }
}

TEST(SkyChecks, AnEvenSkyTellsNothing) {
  LightImage image{{64, 32}, 1};
  std::fill(image.pixels.pixels.begin(), image.pixels.pixels.end(), Imath::half(0.5f));
  EXPECT_EQ(check_orientation(import_as(image, {}, 16), {}, stars()).verdict, SkyVerdict::kUnclear);
}

TEST(SkyChecks, AKnownStarStandsOutOfItsSurroundings) {
  const auto places = known_places(import_as(panorama_of_stars({}), {}, 512), stars());
  ASSERT_EQ(places.size(), 18u);
  EXPECT_EQ(places[0].name, "Sirius");
  EXPECT_GT(places[0].contrast, 3);
}

// With half the texels along a face, each is the mean of four samples, and light is kept.
TEST(PanoramaImport, ACoarserMapIsTheMeanOfFinerLooks) {
  LightImage image{{256, 128}, 2};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x)
      for (int c = 0; c < 3; ++c) image.pixels.row(y)[3 * x + c] = (x + y) % 2 ? 1.0f : 0.0f;
  const SkyMap coarse = import_as(image, {}, 16);
  for (const V3d& d : {sky_direction(10, 5).v, sky_direction(100, -20).v, sky_direction(201, 33).v})
    EXPECT_NEAR(luminance(coarse.sample(d, 0)), 1e-4, 4e-6) << "half of 2 x 1e-4";
}

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
  const FloatImage image = read_image(source_file("shows/assets/milky_way_deep.exr")).pixels;
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
  const SkyMap map =
      map_of_panorama(read_image(source_file("shows/assets/milky_way.exr")).pixels, 512);
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

// Its galaxy is ahead of those who come through a wormhole that stands where one does by default, is
// redder in its heart than in its arms, and ends: the far side of that sky is dark.
TEST(FarSky, HasItsGalaxyAheadAndItsClusterWhereItsStarsAre) {
  const std::string assets = source_file("shows/assets/");
  const SkyMap map = map_of_panorama(read_image(assets + "far_sky.exr").pixels, 512);
  const auto colour = [&map](double ra, double dec, double radius) {
    return map.sample(sky_direction(ra, dec).v, radius * kDegree);
  };
  const auto light = [&](double ra, double dec) {
    return luminance_of(colour(ra, dec, 1)) / kPanoramaUnit;
  };
  EXPECT_GT(light(266.405, -28.936), 20);
  EXPECT_GT(light(256.5, -47.4), 0.5);
  EXPECT_NEAR(light(86.405, 28.936), 0.0084, 0.0005);
  const auto heart = colour(266.405, -28.936, 2), arms = colour(266.405, -28.936, 25);
  EXPECT_GT(heart.r / heart.b, 1.3 * arms.r / arms.b);
  V3d sum(0, 0, 0);
  const StarCatalogue catalogue = read_star_catalogue(assets + "far_stars.stars", 9);
  EXPECT_EQ(catalogue.stars.size(), 29281u);
  for (const Star& star : catalogue.stars) sum += star.direction.v;
  const V3d cluster = sky_direction(179.34, -29.27).v;
  EXPECT_GT(sum.normalized().dot(cluster), std::cos(2 * kDegree));
  EXPECT_NEAR(light(179.34, -29.27), 0.65, 0.05);
}

}  // namespace
}  // namespace domefall
