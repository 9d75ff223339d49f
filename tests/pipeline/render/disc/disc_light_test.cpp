// No light of a disc is lost or made on its way into pixels, however thin its images are.
#include <gtest/gtest.h>

#include <random>

#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/render/disc/exact_disc_light.h"

namespace domefall {
namespace {

constexpr Region kI = Region::kI;
constexpr Tetrad kRain = Tetrad::kRain;

Disc ring(double inner, double outer, double opacity) {
  Disc disc;
  disc.inner = inner;
  disc.outer = outer;
  disc.opacity = opacity;
  return disc;
}

void expect_all_light(const DiscView& view, const Projection& projection, double tolerance) {
  const Show show = disc_show(view, projection);
  const double exact = ExactDiscLight(view).illuminance();
  ASSERT_GT(exact, 0);
  EXPECT_NEAR(illuminance(show, render_floats(show)) / exact, 1, tolerance);
}

Projection flat_image(int size, double degrees) {
  return Stereographic{size, size, degrees * kDegree};
}

DiscView from_afar(double degrees, const Disc& disc) {
  return {{kI, kRain, 60, celerity_of_rest(60)}, normal_seen_from(degrees), disc};
}

TEST(DiscLight, OfARingSeenFromAboveIsThatOfItsExactImages) {
  expect_all_light(from_afar(60, ring(9, 11, 1)), flat_image(256, 50), 2e-4);
}

TEST(DiscLight, OfARingWithAllItsImagesIsThatOfItsExactImages) {
  expect_all_light(from_afar(10, ring(9, 11, 0.5)), flat_image(256, 50), 4e-4);
  expect_all_light(from_afar(10, ring(6, 20, 1)), flat_image(256, 50), 4e-4);
}

// Rings narrower than a pixel: the pixels of this image are as wide as 0.2 M there.
TEST(DiscLight, IsKeptWhereARingIsNarrowerThanAPixel) {
  expect_all_light(from_afar(35, ring(10, 10.1, 0.8)), flat_image(256, 50), 1e-3);
}

// The direct image is a line of a third of a pixel, and less.
TEST(DiscLight, IsKeptOnEdge) {
  const Disc disc = ring(6, 20, 1);
  const Projection projection = flat_image(192, 50);
  for (const double degrees : {0.2, 0.01}) {
    SCOPED_TRACE(degrees);
    expect_all_light(from_afar(degrees, disc), projection, 1e-3);
  }
  // In the plane itself the line has no light, and all else is as next to it: the light changes by
  // 1.6 per mille in a hundredth of a degree.
  const double beside = ExactDiscLight(from_afar(0.01, disc)).illuminance();
  for (const double degrees : {1e-5, 0.0, -1e-9}) {
    const Show show = disc_show(from_afar(degrees, disc), projection);
    EXPECT_NEAR(illuminance(show, render_floats(show)) / beside, 1, 3e-3) << degrees;
  }
}

// Pixels of images of the whole sphere are 0.7 degrees wide here.  What they err by falls with
// their size.
constexpr double kOfTheSphere = 8e-4;

// From among the gas, above it by more or less than a pixel's angle.
TEST(DiscLight, IsKeptWithinTheDisc) {
  for (const double degrees : {20.0, 0.3}) {
    SCOPED_TRACE(degrees);
    expect_all_light(
        {{kI, kRain, 10, celerity_of_rest(10)}, normal_seen_from(degrees), ring(6, 20, 1)},
        Equirectangular{512}, kOfTheSphere);
  }
}

TEST(DiscLight, IsKeptForFastObservers) {
  expect_all_light({{kI, kRain, 25, {0.5, 0.8, -1}}, V3d(0.3, -0.8, 0.4), ring(6, 20, 0.9)},
                   Equirectangular{512}, kOfTheSphere);
}

TEST(DiscLight, IsKeptBetweenDiscAndHoleAndBehindTheHorizon) {
  for (const double r : {4.0, 2.0, 1.0, 0.8})
    expect_all_light(
        {{r > 2 ? kI : Region::kII, kRain, r, {0, 0, 0}}, V3d(0.5, -1, 0), ring(6, 20, 0.9)},
        Equirectangular{512}, kOfTheSphere);
}

}  // namespace
}  // namespace domefall
