#include "pipeline/light/place_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/emission_time.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "tests/pipeline/light/random_rays.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

TEST(PlaceImage, IsTheRayThatPassesThePlace) {
  RandomRays random;
  int found = 0;
  for (int n = 0; n < tries(300, 40); ++n) {
    const Radius at =
        random.one_in(3) ? random.logarithmic(0.05, 2) : 2 + random.logarithmic(1e-6, 1e5);
    const PlaceView view{at, at.above_horizon > 0 && random.one_in(2), false};
    const double r = 3 + random.logarithmic(1e-3, 1e5), psi = random.logarithmic(1e-3, 20);
    const auto image = image_of_place(view, r, psi, 0);
    ASSERT_TRUE(image) << at.r << " " << r << " " << psi;
    const RayPlaces there = place_of(image->ray, psi);
    EXPECT_NEAR(there.r[0] / r, 1, 1e-12 + 1e-14 * std::abs(image->slope) / r * std::max(1.0, psi))
        << at.r << " " << view.outgoing << " " << psi;
    EXPECT_GT(invariants(image->ray).energy, 0);
    ++found;
  }
  EXPECT_GT(found, 0);
}

// The place moves by dr with psi held: the ray turns by dalpha, and around the axis by dchi the
// place moves by r sin(psi) dchi.  Across the light the first is (b/r) dr.
TEST(PlaceImage, HasTheSolidAngleBetweenRaysToPlacesNearby) {
  for (const double at : {0.5, 1.9, 2.1, 3.0, 8.0, 300.0})
    for (const bool outgoing : {false, true})
      for (const double r : {3.5, 7.0, 40.0})
        for (const double psi : {0.3, 1.5, 3.0, 4.0, 7.0}) {
          if (outgoing && at < 2) continue;
          const PlaceView view{at, outgoing, false};
          const auto image = image_of_place(view, r, psi, 0);
          const auto nearer = image_of_place(view, r * (1 - 1e-5), psi, 0);
          const auto farther = image_of_place(view, r * (1 + 1e-5), psi, 0);
          ASSERT_TRUE(image && nearer && farther);
          const RayInvariants k = invariants(image->ray);
          const double b = k.angular_momentum / k.energy;
          const double width = b / r * (2e-5 * r) * r * std::abs(std::sin(psi));
          const double angle = std::abs(alpha_of(farther->ray) - alpha_of(nearer->ray)) *
                               std::sin(alpha_of(image->ray));
          const double rounding = 1e-15 / std::abs(alpha_of(farther->ray) - alpha_of(nearer->ray));
          EXPECT_NEAR(image->solid_angle_per_area * width / angle, 1, 1e-7 + rounding)
              << at << " " << outgoing << " " << r << " " << psi;
        }
}

TEST(PlaceImage, IsStraightFarFromTheHole) {
  const PlaceView view{1e8, true, false};
  const auto image = image_of_place(view, 2e8, pi / 3, 0);
  ASSERT_TRUE(image);
  const double apart = 1e8 * std::sqrt(1 + 4 - 4 * std::cos(pi / 3));
  EXPECT_NEAR(image->solid_angle_per_area * apart * apart, 1, 1e-3);
  const double t = image->null_time - Schwarzschild::tortoise(1e8) + Schwarzschild::tortoise(2e8);
  EXPECT_NEAR(-t / apart, 1, 1e-6);
}

// The area of a radial beam grows as the square of its affine parameter.
TEST(PlaceImage, GoesOverIntoTheRadialOne) {
  for (const double at : {0.5, 1.5, 2.5, 10.0})
    for (const bool outgoing : {false, true})
      for (const double r : {3.5, 6.0, 50.0}) {
        if (outgoing && at < 2) continue;
        const PlaceView view{at, outgoing, false};
        const auto radial = image_of_place(view, r, 0, 0), next = image_of_place(view, r, 1e-5, 0);
        ASSERT_TRUE(radial && next);
        EXPECT_NEAR(next->solid_angle_per_area / radial->solid_angle_per_area, 1, 1e-4)
            << at << " " << r;
        EXPECT_NEAR(next->null_time, radial->null_time, 1e-6 * r)
            << at << " " << outgoing << " " << r;
      }
}

// Each turn takes e^(2 pi) of the light: the photon rings' law.
TEST(PlaceImage, OfEachFurtherTurnHasTheLightOfThePhotonRings) {
  const PlaceView view{20, false, false};
  const double psi = 1.2;
  double before = image_of_place(view, 10, psi + 2 * pi, 0)->solid_angle_per_area;
  for (int turn = 2; turn <= 3; ++turn) {
    const double light = image_of_place(view, 10, psi + 2 * pi * turn, 0)->solid_angle_per_area;
    EXPECT_NEAR(before / light / std::exp(2 * pi), 1, turn == 2 ? 2e-2 : 1e-4);
    before = light;
  }
}

TEST(PlaceImage, IsNoneFromRegionFour) {
  EXPECT_FALSE(image_of_place({1.0, true, false}, 10, 1, 0));
}

TEST(PlaceImage, OfRegionThreeIsThatOfRegionOneMirroredWithoutEnergyAtTheBifurcation) {
  // t -> -t swaps the regions: a place is seen in III by light of E < 0.
  const auto image = image_of_place({1.0, false, true}, 10, 1, 0);
  ASSERT_TRUE(image);
  EXPECT_LT(invariants(image->ray).energy, 0);
  EXPECT_NEAR(place_of(image->ray, 1).r[0], 10, 1e-11);
}

}  // namespace
}  // namespace domefall
