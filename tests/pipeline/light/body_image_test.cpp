#include "pipeline/light/body_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/emission_time.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "tests/pipeline/light/resting_body.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kForEver = std::numeric_limits<double>::infinity();

// A body on a circular orbit about `axis`, which at t = 0 is at `start`.
BodyMotion circular(double r, const V3d& axis, const V3d& start) {
  const double rate = 1 / (r * std::sqrt(r)), u_t = 1 / std::sqrt(1 - 3 / r);
  // Against the rain: u^Phi = 1/sqrt(r - 3), and u^R = sqrt(2/(r - 3)), since u^r = 0.
  const double around = 1 / std::sqrt(r - 3), outwards = std::sqrt(2) * around;
  return {[=](double tau) {
            const double t = u_t * tau;
            const V3d across = axis.cross(start);
            return BodyPoint{start * std::cos(rate * t) + across * std::sin(rate * t),
                             r,
                             t + Schwarzschild::tortoise(r),
                             std::sqrt(1 + 3 * around * around),
                             outwards,
                             axis * (r * around)};
          },
          -kForEver, kForEver};
}

// Rain itself, which crosses r = 2 at tau = v = 0.
BodyMotion falling(const V3d& direction) {
  const auto null_time = [](double r) {
    const double x = std::sqrt(r / 2);
    return -4 * (x * (1 + x * (x / 3 - 0.5)) - std::log1p(x));
  };
  const double at_end = 4.0 / 3;
  return {[=](double tau) {
            const double r = 2 * std::pow(1 - tau / at_end, 2.0 / 3);
            return BodyPoint{direction, r, null_time(r) - null_time(2), 1, 0, V3d(0, 0, 0)};
          },
          -kForEver, at_end};
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
        const auto image = image_of_body(view, 0, resting_body(r, V3d(0.6, 0.8, 0)), order, 0);
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
    const BodyPoint then = motion.at(image->proper_time);
    const V3d n = then.direction;
    const double angle = std::acos(n.x), psi = order == 0   ? angle
                                               : order == 1 ? 2 * pi - angle
                                                            : 2 * pi + angle;
    const auto place = image_of_place(view, 20, psi, 0);
    ASSERT_TRUE(place);
    EXPECT_NEAR(then.null_time, 1000 + place->null_time, 2e-9);
    EXPECT_EQ(image->direction.y * n.y > 0, order != 1);
    const double t_observer = 1000 - Schwarzschild::tortoise(50);
    const double t = then.null_time - Schwarzschild::tortoise(20);
    EXPECT_GT(t_observer - t, 25);  // light needs so long at least
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
      EXPECT_LT(image->proper_time, 0);
      EXPECT_LT(image->proper_time, before);
      before = image->proper_time;
    }
  }
}

// Light that goes straight out keeps u: from afar each 4 M of waiting redden what falls by a factor
// e.
TEST(BodyImage, OfWhatFallsReddensForEver) {
  const PlaceView view{100, false, false};
  const BodyMotion motion = falling(V3d(1, 0, 0));
  double before = 0;
  for (const double v : {250.0, 254.0, 258.0, 262.0}) {
    const auto image = image_of_body(view, v, motion, 0, 0);
    ASSERT_TRUE(image) << v;
    EXPECT_GT(image->r, 2);
    EXPECT_LT(image->proper_time, 0);
    if (before > 0) {
      EXPECT_NEAR(before / image->frequency_ratio, std::exp(1), 0.05);
    }
    before = image->frequency_ratio;
  }
  EXPECT_LT(before, 1e-4);
  EXPECT_GT(before, 0);
}

// Who falls in the same rain, behind it, sees it before, at and behind the horizon, always ahead
// and without a jump, and both are at r = 2 at the same instant.
TEST(BodyImage, OfWhatFallsAheadIsSeenAcrossTheHorizon) {
  int crossings = 0;
  for (const V3d& aside : {V3d(1, 0, 0), V3d(std::cos(0.3), std::sin(0.3), 0)}) {
    const BodyMotion ahead = falling(aside), own = falling(V3d(1, 0, 0));
    const double behind = 1.5;  // v of the observer's crossing
    double before = HUGE_VAL, shift = 0;
    for (double tau = -2; tau < 1; tau += 0.03125) {
      const BodyPoint at = own.at(tau);
      if (std::abs(at.r - 2) < 1e-9) continue;
      const auto image = image_of_body({at.r, false, false}, at.null_time + behind, ahead, 0, 0);
      ASSERT_TRUE(image) << tau << " " << at.r;
      EXPECT_LT(image->r, before) << tau;
      EXPECT_LT(image->direction.x, 0) << tau;
      if (shift > 0) {
        EXPECT_NEAR(image->frequency_ratio / shift, 1, 0.2) << tau;
      }
      // Light that stays on the horizon loses a factor e in each 4 M of v.
      if (aside == V3d(1, 0, 0) && std::abs(at.r - 2) < 0.05) {
        EXPECT_NEAR(image->frequency_ratio, std::exp(-behind / 4), 0.03) << at.r;
        ++crossings;
      }
      before = image->r;
      shift = image->frequency_ratio;
    }
    EXPECT_LT(before, 1.5);
  }
  EXPECT_GT(crossings, 0);
}

}  // namespace
}  // namespace domefall
