#include "pipeline/light/sphere_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pipeline/light/resting_body.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A body at rest at psi radians from the observer's radial direction.
BodyMotion at_rest(double r, double psi) {
  return resting_body(r, V3d(std::cos(psi), std::sin(psi), 0));
}

double light_of(const std::vector<SpherePiece>& pieces) {
  double sum = 0;
  for (const SpherePiece& piece : pieces) sum += piece.at.amplification;
  return sum;
}

double angle_from_hole(const V3d& d) { return std::atan2(std::hypot(d.y, d.z), -d.x); }

std::vector<SpherePiece> in_fine_pieces(const BodyImage& image, double radius) {
  const double size = size_of_sphere(image, radius);
  return image_of_sphere(image, radius, [size](const V3d&) { return size / 100; });
}

TEST(SphereImage, HasTheSolidAngleOfItsDisc) {
  constexpr double kRadius = 1e-3;
  for (const double observer : {1.5, 12.0, 300.0})
    for (const double r : {4.0, 10.0, 40.0})
      for (const double psi : {0.4, 1.5, 2.9})
        for (const int order : {0, 1, 2}) {
          const PlaceView view{observer, false, false};
          const auto image = image_of_body(view, 0, at_rest(r, psi), order, kRadius);
          ASSERT_TRUE(image);
          EXPECT_NEAR(light_of(in_fine_pieces(*image, kRadius)) /
                          (image->solid_angle_per_area * pi * kRadius * kRadius),
                      1, 2e-3)
              << observer << " " << r << " " << psi << " " << order;
        }
}

// Of a small circle about the body in the plane of its light, of whose points the observer sees
// the outermost ones at the ends of the image.
TEST(SphereImage, ReachesAsFarAsTheRaysThatTouchTheSphere) {
  constexpr double kRadius = 1e-3;
  for (const double observer : {1.5, 12.0, 300.0})
    for (const double r : {4.0, 10.0, 40.0})
      for (const double psi : {0.4, 1.5, 3.1}) {
        const PlaceView view{observer, false, false};
        const auto image = image_of_body(view, 0, at_rest(r, psi), 0, kRadius);
        ASSERT_TRUE(image);
        double least = HUGE_VAL, most = 0;
        for (int k = 0; k < 32; ++k) {
          const double u = 2 * pi * k / 32;
          const auto touched =
              image_of_place(view, r + kRadius * std::sqrt(1 - 2 / r) * std::cos(u),
                             psi + kRadius / r * std::sin(u), 0);
          ASSERT_TRUE(touched);
          least = std::min(least, alpha_of(touched->ray));
          most = std::max(most, alpha_of(touched->ray));
        }
        const double length = 2 * image->angle_per_length * kRadius;
        EXPECT_NEAR((most - least) / length, 1, 6e-3) << observer << " " << r << " " << psi;
        const auto before = image_of_place(view, r, psi - 1e-5, 0),
                   behind = image_of_place(view, r, psi + 1e-5, 0);
        ASSERT_TRUE(before && behind);
        EXPECT_NEAR((alpha_of(behind->ray) - alpha_of(before->ray)) / (2e-5 * image->angle_per_psi),
                    1, 1e-5);
      }
}

// The light of a point behind the hole goes with the inverse of its distance from the axis.  Over a
// disc it has a finite sum, which is independent of how the ring is drawn.
TEST(SphereImage, BehindTheHoleIsARingWithTheLightOfAllItsPoints) {
  constexpr double kRadius = 1e-3, kR = 10;
  const PlaceView view{30, false, false};
  const auto near = image_of_place(view, kR, pi - 1e-5, 0);
  ASSERT_TRUE(near);
  const double times_distance = near->solid_angle_per_area * kR * 1e-5;
  for (const double share : {0.0, 0.3, 0.9, 1.1, 3.0}) {  // of the radius, from the axis
    // Where light comes in at a slant the disc, seen from the axis, is an ellipse for each plane;
    // along the light the sphere is as wide in all: integrate over the disc in planes of the axis.
    double expected = 0;
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      const double azimuth = pi * (k + 0.5) / kSteps, across = share * std::sin(azimuth);
      if (across < 1) expected += 2 * std::sqrt((1 - across) * (1 + across)) * 2 * pi / kSteps;
    }
    // Both orders, each over the half of the planes on its side; far away nothing but one is left.
    double light = 0;
    for (const int order : {0, 1}) {
      const auto image = image_of_body(view, 0, at_rest(kR, pi - share * kRadius / kR), order, 0.1);
      ASSERT_TRUE(image);
      const std::vector<SpherePiece> pieces = in_fine_pieces(*image, kRadius);
      light += light_of(pieces);
      for (const SpherePiece& piece : pieces)
        EXPECT_NEAR(angle_from_hole(piece.at.direction.v), angle_from_hole(image->direction), 1e-3);
    }
    EXPECT_NEAR(light / (times_distance * kRadius * expected), 1, 5e-3) << share;
  }
}

// Right above the observer a sphere is seen as a round disc, without a caustic.
TEST(SphereImage, InFrontIsRound) {
  constexpr double kRadius = 1e-3;
  for (const double psi : {0.0, 2e-5, 1e-3}) {
    const PlaceView view{10, false, false};
    const auto image = image_of_body(view, 0, at_rest(20, psi), 0, kRadius);
    ASSERT_TRUE(image);
    const std::vector<SpherePiece> pieces = in_fine_pieces(*image, kRadius);
    EXPECT_NEAR(light_of(pieces) / (image->solid_angle_per_area * pi * kRadius * kRadius), 1, 3e-3);
    for (const SpherePiece& piece : pieces)
      EXPECT_LT((piece.at.direction.v - image->direction).length(),
                kRadius * std::sqrt(image->solid_angle_per_area) * 1.01);
  }
}

}  // namespace
}  // namespace domefall
