#include "pipeline/sky/make/sky_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/image/read_image.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/make/panorama.h"
#include "tests/source_tree.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

using std::numbers::pi;

const std::string kMapFolder = source_file("shows/assets/");

const StarCatalogue& stars() {
  static const StarCatalogue catalogue = read_star_catalogue(kMapFolder + "stars_to_9.stars", 6.5);
  return catalogue;
}

V3d direction_at(double longitude, double latitude) {
  const double a = longitude * kDegree, b = latitude * kDegree;
  return {std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)};
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
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), direction_at(270, 0)), middle));
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), direction_at(0, 0)), left));
  o.longitude_right = true;
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), direction_at(180, 0)), left));
  o.south_up = true;
  EXPECT_TRUE(near(apply(panorama_from_equatorial(o), direction_at(0, -90)), top));
  const M33d galactic = panorama_from_equatorial({SkyFrame::kGalactic, false, false, 0});
  // The galactic centre and the north galactic pole (J2000).
  EXPECT_TRUE((apply(galactic, direction_at(266.40500, -28.93617)) - middle).length() < 1e-5);
  EXPECT_TRUE((apply(galactic, direction_at(192.85948, 27.12825)) - top).length() < 1e-5);
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
  const FloatImage whole = read_image(kMapFolder + "milky_way_deep.exr");
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
  const SkyMap sky = map_of_panorama(read_image(kMapFolder + "milky_way_deep.exr"));
  const Orientation truth{SkyFrame::kGalactic, false, false, 0};
  const M33d panorama = panorama_from_equatorial(truth);
  LightImage image{{512, 256}, kPanoramaUnit};
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const V3d d = apply_transposed(
          panorama, direction_at(180 - (x + 0.5) * 360 / 512, 90 - (y + 0.5) * 180 / 256));
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
  for (const V3d& d : {direction_at(10, 5), direction_at(100, -20), direction_at(201, 33)})
    EXPECT_NEAR(luminance(coarse.sample(d, 0)), 1e-4, 4e-6) << "half of 2 x 1e-4";
}

}  // namespace
}  // namespace domefall
