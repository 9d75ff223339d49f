// Images of bodies near a charge.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "pipeline/light/body_image.h"
#include "tests/pipeline/light/charged_orbits.h"
#include "tests/pipeline/light/resting_body.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kAlways = std::numeric_limits<double>::infinity();

// A body at rest against T.
BodyMotion resting(const ChargedHole& hole, double r, const V3d& direction) {
  const double w = hole.resting_celerity(r), rate = std::sqrt(hole.lapse_squared(r));
  return {[=](double tau) {
            return BodyPoint{direction,        r, tau / rate + hole.tortoise(r),
                             std::hypot(1, w), w, V3d(0, 0, 0)};
          },
          -kAlways, kAlways};
}
// Free fall from rest at infinity, by numbers: dr/dtau = -sqrt(2r - q^2)/r and dv/dtau = 1/(1 + s).
BodyMotion falling(const ChargedHole& hole, const V3d& direction, double from_r) {
  const double q2 = hole.charge * hole.charge;
  // tau = (r + q^2) sqrt(2r - q^2)/3, falling.
  const auto fallen = [q2](double r) { return (r + q2) * std::sqrt(2 * r - q2) / 3; };
  const double start = fallen(from_r), end = start - fallen(hole.inner_horizon());
  return {[=](double tau) {
            double low = hole.inner_horizon(), high = 1e4;
            for (int k = 0; k < 80; ++k) {
              const double r = (low + high) / 2;
              (fallen(r) < start - tau ? low : high) = r;
            }
            const double r = (low + high) / 2;
            // v by Simpson's rule in tau's own r.
            double sum = 0;
            constexpr int kParts = 400;
            for (int k = 0; k <= kParts; ++k) {
              const double x = std::sqrt(from_r) + (std::sqrt(r) - std::sqrt(from_r)) * k / kParts,
                           at = x * x;
              const double s = std::sqrt(2 * at - q2) / at;
              sum += (k == 0 || k == kParts ? 1 : k % 2 ? 4 : 2) * (-1 / (s * (1 + s))) * 2 * x;
            }
            const double v = sum * (std::sqrt(r) - std::sqrt(from_r)) / kParts / 3;
            const double w = hole.fall_celerity(r);
            return BodyPoint{direction, r, v, std::hypot(1, w), w, V3d(0, 0, 0)};
          },
          -100, end};
}

// The tetrad's light as who rests at r has it, for a direction of view.
double ratio_at_rest(const ChargedHole& hole, double r, const BodyImage& image) {
  const double w = hole.resting_celerity(r);
  return image.frequency_ratio * (std::hypot(1, w) + w * image.direction.x);
}

// E of light that is one in the tetrad, of that direction.
double energy_of(const ChargedHole& hole, double r, const V3d& n) {
  const double f = hole.lapse_squared(r);
  return (1 + f) / 2 + (1 - f) / 2 * n.x;
}

TEST(ChargedPlaceImage, IsTheRayThatIsFollowedToThePlace) {
  std::mt19937 random(4);
  const auto between = [&random](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
  };
  int seen = 0;
  for (const double charge : {0.3, 0.9, 1.0})
    for (const double observer : {1.2, 2.2, 6.0, 50.0}) {
      const ChargedHole hole(1, charge);
      if (observer < hole.inner_horizon()) continue;
      for (int k = 0; k < 12; ++k) {
        const double r = hole.horizon() * (1.02 + 8 * std::pow(between(0, 1), 3)),
                     psi = between(0.05, 8);
        const auto image = image_of_place(ChargedPlaceView{hole, observer}, r, psi, 0);
        SCOPED_TRACE(testing::Message() << charge << " " << observer << " " << r << " " << psi);
        if (!image) {
          EXPECT_LT(observer, hole.horizon());
          continue;
        }
        ++seen;
        const Label label = label_of(hole, observer, image->sin_half / image->cos_half);
        const Followed there = follow(hole, observer, label, psi);
        // The ray itself is given to 1e-16 only, and rays part by e^psi at most.
        const double loose = 1e-12 + 3e-15 * std::exp(psi);
        EXPECT_NEAR(static_cast<double>(there.w) * r, 1, r * loose * 10);
        EXPECT_NEAR(image->slope, static_cast<double>(-there.slope) * r * r, 100 * loose * r * r);
        EXPECT_NEAR(image->null_time, static_cast<double>(there.time),
                    (1e-9 + 1e4 * loose) * (1 + std::abs(image->null_time)));
        EXPECT_GT(image->energy, 0);
      }
    }
  EXPECT_GT(seen, 80);
}

// Of rays to places nearby: the place moves by dr with psi held, and across the ray's plane.
TEST(ChargedPlaceImage, HasTheSolidAngleOfTheRaysToPlacesNearby) {
  const double h = 1e-5;
  for (const double charge : {0.5, 1.0})
    for (const double observer : {3.0, 30.0})
      for (const double psi : {0.4, 2.0, 4.0, 7.0}) {
        const ChargedHole hole(1, charge);
        const ChargedPlaceView view{hole, observer};
        const double r = 5;
        const auto image = image_of_place(view, r, psi, 0),
                   nearer = image_of_place(view, r * (1 - h), psi, 0),
                   farther = image_of_place(view, r * (1 + h), psi, 0),
                   before = image_of_place(view, r, psi - h, 0),
                   behind = image_of_place(view, r, psi + h, 0);
        ASSERT_TRUE(image && nearer && farther && before && behind);
        const auto alpha = [](const auto& light) {
          return 2 * std::atan2(light->sin_half, light->cos_half);
        };
        const double rise = (alpha(farther) - alpha(nearer)) / (2 * h * r),
                     sine = std::sin(alpha(image));
        // Light and dr make the area dr (L/(E r)) r |sin psi| dchi.
        const double area = image->angular_momentum / image->energy * std::abs(std::sin(psi));
        const double loose = 1e-6 + 1e-10 * std::exp(psi);
        EXPECT_NEAR(image->solid_angle_per_area * area / (sine * rise), 1, loose)
            << charge << " " << observer << " " << psi;
        EXPECT_NEAR(image->angle_per_length * image->angular_momentum / (image->energy * r * rise),
                    1, loose);
        EXPECT_NEAR(image->angle_per_psi / ((alpha(behind) - alpha(before)) / (2 * h)), 1,
                    100 * loose);
      }
}

TEST(ChargedBodyImage, OfABodyAtRestIsShiftedByItsDepth) {
  for (const double charge : {0.6, 1.0})
    for (const double observer : {4.0, 40.0, 1e4})
      for (const double r : {2.05, 3.0, 8.0})
        for (int order = 0; order < 4; ++order) {
          const ChargedHole hole(1, charge);
          const auto image = image_of_body(ChargedPlaceView{hole, observer}, 0,
                                           resting(hole, r, V3d(0.6, 0.8, 0)), order, 0);
          ASSERT_TRUE(image) << observer << " " << r << " " << order;
          const double expected = std::sqrt(hole.lapse_squared(r) / hole.lapse_squared(observer));
          EXPECT_NEAR(ratio_at_rest(hole, observer, *image) / expected, 1, 1e-10);
        }
}

// In the plane of the orbit 1 + z = u^t (1 -+ b Omega).
TEST(ChargedBodyImage, InItsPlaneIsShiftedByTheImpactParameterOfItsLight) {
  const double far = 1e4, r = 7;
  for (const double charge : {0.5, 1.0}) {
    const ChargedHole hole(1, charge);
    const double q2 = charge * charge, omega = std::sqrt(r - q2) / (r * r),
                 u_t = 1 / std::sqrt(1 - 3 / r + 2 * q2 / (r * r));
    for (int k = 0; k < 8; ++k)
      for (const int order : {0, 1}) {
        const double phi = 2 * pi * (k + 0.3) / 8;
        const auto image = image_of_body(
            ChargedPlaceView{hole, far}, 0,
            circling_body(hole, r, V3d(0, 0, 1), V3d(std::cos(phi), std::sin(phi), 0)), order, 0);
        ASSERT_TRUE(image);
        const double b = far * image->direction.y / energy_of(hole, far, image->direction);
        const double redder =
            ratio_at_rest(hole, far, *image) / std::sqrt(1 / hole.lapse_squared(far));
        EXPECT_NEAR(1 / redder, u_t * (1 + b * omega), 1e-9);
      }
  }
}

// With a charge of 1e-7 nothing differs by 1e-9.  T falls faster than rain: frequencies are compared
// by E, solid angles by its square, and angles by tan(alpha/2).
TEST(ChargedBodyImage, TendsToThatOfAHoleWithoutCharge) {
  const ChargedHole hole(1, 1e-7L);
  for (const double observer : {1.3, 2.5, 9.0, 100.0})
    for (const double r : {2.3, 4.0, 12.0})
      for (int order = 0; order < 3; ++order) {
        const V3d place(0.6, 0.64, 0.48);
        const auto plain =
            image_of_body(PlaceView{observer, false, false}, 5, resting_body(r, place), order, 0);
        const auto charged =
            image_of_body(ChargedPlaceView{hole, observer}, 5, resting(hole, r, place), order, 0);
        ASSERT_EQ(plain.has_value(), charged.has_value()) << observer << " " << r << " " << order;
        if (!plain) continue;
        const double s = std::sqrt(2 / observer), loose = 1e-9 * std::exp(pi * order);
        const auto tangent = [](const V3d& n) { return std::hypot(n.y, n.z) / (1 - n.x); };
        EXPECT_NEAR(tangent(charged->direction) / (tangent(plain->direction) * (1 + s)), 1, loose);
        const double in_rain = 1 + s * plain->direction.x,
                     in_t = energy_of(hole, observer, charged->direction);
        EXPECT_NEAR(charged->frequency_ratio * in_t / (plain->frequency_ratio * in_rain), 1, loose);
        EXPECT_NEAR(charged->solid_angle_per_area * in_rain * in_rain /
                        (plain->solid_angle_per_area * in_t * in_t),
                    1, 1e-6);
        EXPECT_NEAR(charged->proper_time, plain->proper_time,
                    1e-8 * (1 + std::abs(plain->proper_time)));
      }
}

// Who falls behind sees it before, at and behind the horizon, without a jump, as without charge.
TEST(ChargedBodyImage, OfWhatFallsAheadIsSeenAcrossTheHorizon) {
  for (const double charge : {0.6, 0.95}) {
    const ChargedHole hole(1, charge);
    const V3d aside(std::cos(0.05), std::sin(0.05), 0);
    const BodyMotion ahead = falling(hole, aside, hole.horizon()),
                     own = falling(hole, V3d(1, 0, 0), hole.horizon());
    double before = HUGE_VAL, shift = 0;
    for (double tau = -3; tau < own.end * 0.7; tau += 0.0625) {
      const BodyPoint at = own.at(tau);
      const auto image =
          image_of_body(ChargedPlaceView{hole, at.r}, at.null_time + 0.6, ahead, 0, 0);
      ASSERT_TRUE(image) << tau << " " << at.r;
      EXPECT_LT(image->r, before) << tau;
      EXPECT_LT(image->direction.x, 0) << tau;
      if (shift > 0) {
        EXPECT_NEAR(image->frequency_ratio / shift, 1, 0.3) << tau << " " << at.r;
      }
      before = image->r;
      shift = image->frequency_ratio;
    }
    EXPECT_LT(before, hole.horizon());
  }
}

// From afar each 1/kappa of waiting reddens what falls by a factor e, kappa = sqrt(1 - q^2)/r_+^2.
TEST(ChargedBodyImage, OfWhatFallsReddensForEver) {
  const ChargedHole hole(1, 0.8L);
  const double span = hole.horizon() * hole.horizon() / 0.6;
  const BodyMotion motion = falling(hole, V3d(1, 0, 0), hole.horizon());
  double before = 0;
  for (int k = 0; k < 4; ++k) {
    const auto image = image_of_body(ChargedPlaceView{hole, 100}, 250 + k * span, motion, 0, 0);
    ASSERT_TRUE(image) << k;
    EXPECT_GT(image->r, hole.horizon());
    if (before > 0) {
      EXPECT_NEAR(before / image->frequency_ratio, std::exp(1), 0.05);
    }
    before = image->frequency_ratio;
  }
}

}  // namespace
}  // namespace domefall
