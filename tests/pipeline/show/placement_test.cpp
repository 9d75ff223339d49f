#include "pipeline/show/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

constexpr double kPi = std::numbers::pi;
// This allows for products of a few rounded sines and cosines.
constexpr double kPlaceRounding = 1e-15;

void expect_same_place(const V3d& a, const V3d& b, double tolerance = kPlaceRounding) {
  EXPECT_LE((a - b).length(), tolerance) << a << " and " << b;
}

SkyDirection placed_at(double ra, double dec) {
  return {V3d(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec))};
}

TEST(Placement, IsARightHandedRotationAnywhere) {
  for (double ra = 0; ra < 6.3; ra += 0.7)
    for (double dec : {-kPi / 2, -1.0, 0.0, 0.4, kPi / 2})
      for (double heading : {0.0, 1.0, -2.5})
        for (double azimuth : {0.0, 0.3, 100.0}) {
          const M33d m = place_tetrad(placed_at(ra, dec), heading, azimuth);
          const V3d r = column(m, 0), theta = column(m, 1), phi = column(m, 2);
          expect_same_place(r.cross(theta), phi);
          EXPECT_NEAR(r.length(), 1, kPlaceRounding);
          EXPECT_NEAR(theta.length(), 1, kPlaceRounding);
          EXPECT_NEAR(r.dot(theta), 0, kPlaceRounding);
        }
}

TEST(Placement, StartsWithTheHoleWhereItIsSeen) {
  const SkyDirection hole = placed_at(4.6, -0.5);
  expect_same_place(column(place_tetrad(hole, 1.2, 0), 0), -hole.v);
}

TEST(Placement, HeadingZeroIsNorthAndNinetyDegreesIsEast) {
  const SkyDirection hole{V3d(-1, 0, 0)};  // so R0 is at RA 0, Dec 0, where east is +y
  expect_same_place(column(place_tetrad(hole, 0, 0), 2), V3d(0, 0, 1));
  expect_same_place(column(place_tetrad(hole, kPi / 2, 0), 2), V3d(0, 1, 0));
}

TEST(Placement, AQuarterTurnBringsTheObserverToWhereItWasHeading) {
  const SkyDirection hole = placed_at(2, 0.3);
  const M33d start = place_tetrad(hole, 0.8, 0), later = place_tetrad(hole, 0.8, kPi / 2);
  expect_same_place(column(later, 0), column(start, 2));
  expect_same_place(column(later, 2), -column(start, 0));
  expect_same_place(column(later, 1), column(start, 1));
}

TEST(Placement, AtAPoleTheMeridianOfRightAscensionZeroIsNorth) {
  expect_same_place(column(place_tetrad({V3d(0, 0, -1)}, 0, 0), 2), V3d(-1, 0, 0));
  expect_same_place(column(place_tetrad(placed_at(1.7, kPi / 2), kPi / 2, 0), 2), V3d(0, 1, 0));
}

}  // namespace
}  // namespace domefall
