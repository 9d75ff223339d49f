#include "pipeline/optics/body_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/optics/emission_time.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A body on a circular orbit about `axis`, which at t = 0 is at `start`.
BodyMotion circular(double r, const V3d& axis, const V3d& start) {
  const double rate = 1 / (r * std::sqrt(r)), u_t = 1 / std::sqrt(1 - 3 / r);
  return [=](double t) {
    const V3d across = axis.cross(start);
    return BodyPoint{start * std::cos(rate * t) + across * std::sin(rate * t), r, (1 - 2 / r) * u_t,
                     0, axis * (r * r * rate * u_t)};
  };
}

BodyMotion at_rest(double r, const V3d& direction) {
  return [=](double) { return BodyPoint{direction, r, std::sqrt(1 - 2 / r), 0, V3d(0, 0, 0)}; };
}

// The shift for an observer at rest, not in free fall: light of the tetrad, boosted along R.
double ratio_at_rest(const PlaceView& view, const BodyImage& image) {
  const double s = std::sqrt(2 / view.at.r), gamma = 1 / std::sqrt(1 - s * s);
  const double away = view.outgoing ? -s : s;  // of the one at rest, along R in the tetrad
  return image.frequency_ratio * gamma * (1 + away * image.direction.x);
}

TEST(BodyImage, OfABodyAtRestIsShiftedByItsDepth) {
  for (const double observer : {5.0, 40.0, 1e4})
    for (const double r : {2.1, 3.0, 8.0})
      for (int order = 0; order < 3; ++order) {
        const PlaceView view{observer, false, false};
        const auto image = image_of_body(view, 0, at_rest(r, V3d(0.6, 0.8, 0)), order, 0);
        ASSERT_TRUE(image) << observer << " " << r << " " << order;
        const double expected = std::sqrt((1 - 2 / r) / (1 - 2 / observer));
        EXPECT_NEAR(ratio_at_rest(view, *image) / expected, 1, 1e-11);
      }
}

TEST(BodyImage, FromAboveItsOrbitIsShiftedByTheSquareRootOfOneLessThreeOverR) {
  const PlaceView view{1e8, true, false};
  for (const double r : {3.5, 6.0, 30.0}) {
    const auto image = image_of_body(view, 0, circular(r, V3d(1, 0, 0), V3d(0, 1, 0)), 0, 0);
    ASSERT_TRUE(image);
    EXPECT_NEAR(ratio_at_rest(view, *image), std::sqrt(1 - 3 / r), 1e-6) << r;
  }
}

// In the plane of the orbit 1 + z = (1 -+ b Omega)/sqrt(1 - 3/r).
TEST(BodyImage, InItsPlaneIsShiftedByTheImpactParameterOfItsLight) {
  const double r = 10, rate = std::pow(r, -1.5), far = 1e8;
  const PlaceView view{far, true, false};
  for (int k = 0; k < 8; ++k)
    for (const int order : {0, 1}) {
      const double phi = 2 * pi * (k + 0.3) / 8;
      const auto image = image_of_body(
          view, 0, circular(r, V3d(0, 0, 1), V3d(std::cos(phi), std::sin(phi), 0)), order, 0);
      ASSERT_TRUE(image);
      // Of light that is seen on the side of Theta: L/E, E = 1 + s cos(delta).
      const double b = far * image->direction.y / (1 - std::sqrt(2 / far) * image->direction.x);
      EXPECT_NEAR(1 / ratio_at_rest(view, *image), (1 + b * rate) / std::sqrt(1 - 3 / r), 1e-6);
    }
}

// Light of the direct image comes straight from where the body was when it left.
TEST(BodyImage, IsSeenAtItsRetardedPlace) {
  const PlaceView view{50, false, false};
  const BodyMotion motion = circular(20, V3d(0, 0, 1), V3d(0, 1, 0));
  for (int order = 0; order < 3; ++order) {
    const auto image = image_of_body(view, 1000, motion, order, 0);
    ASSERT_TRUE(image);
    const V3d n = motion(image->t).direction;
    const double angle = std::acos(n.x), psi = order == 0   ? angle
                                               : order == 1 ? 2 * pi - angle
                                                            : 2 * pi + angle;
    const auto place = image_of_place(view, 20, psi, 0);
    ASSERT_TRUE(place);
    EXPECT_NEAR(image->t, 1000 + place->null_time - tortoise(20), 2e-9);
    EXPECT_EQ(image->direction.y * n.y > 0, order != 1);
    const double t_observer = 1000 - tortoise(50);
    EXPECT_GT(t_observer - image->t, 25);  // light needs so long at least
  }
}

// From inside the horizon the way out is one way: all orders are seen beyond the silhouette's edge.
TEST(BodyImage, IsSeenByWhoHasFallenIn) {
  for (const double observer : {1.9, 1.0, 0.2}) {
    const PlaceView view{observer, false, false};
    const BodyMotion motion = circular(10, V3d(0, 0, 1), V3d(1, 0, 0));
    double before = HUGE_VAL;
    for (int order = 0; order < 4; ++order) {
      const auto image = image_of_body(view, 0, motion, order, 0);
      ASSERT_TRUE(image);
      EXPECT_LT(image->t, 0);
      EXPECT_LT(image->t, before);
      before = image->t;
    }
  }
}

}  // namespace
}  // namespace domefall
