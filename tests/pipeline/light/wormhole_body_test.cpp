// Images of places and bodies in a wormhole, against rays that are followed in small steps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/body_image.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kAlways = std::numeric_limits<double>::infinity();
constexpr Wormhole kEllis{.profile = Wormhole::Profile::kEllis};
constexpr Wormhole kWide{.profile = Wormhole::Profile::kDngr, .length = 1, .lensing_width = 0.5};
constexpr Wormhole kShort{.profile = Wormhole::Profile::kDngr, .length = 1e-6, .lensing_width = 1};

struct Point {
  double l, psi;
};

// Follows the light seen at alpha from -R back for this long, by the classical Runge-Kutta method.
// With b = r sin(alpha): l'' = b^2 r'/r^3 and psi' = b/r^2.
Point followed(const Wormhole& w, double l, double alpha, double long_for) {
  constexpr int kSteps = 6000;
  const double b = w.radius(l) * std::sin(alpha), h = long_for / kSteps;
  using State = std::array<double, 3>;
  const auto rate = [&](const State& s) -> State {
    const double r = w.radius(s[0]);
    return {s[1], b * b * w.slope(s[0]) / (r * r * r), b / (r * r)};
  };
  const auto plus = [](const State& s, const State& d, double by) -> State {
    return {s[0] + d[0] * by, s[1] + d[1] * by, s[2] + d[2] * by};
  };
  State s{l, -std::cos(alpha), 0};
  for (int k = 0; k < kSteps; ++k) {
    const State a = rate(s), c = rate(plus(s, a, h / 2)), d = rate(plus(s, c, h / 2)),
                e = rate(plus(s, d, h));
    for (std::size_t i = 0; i < 3; ++i) s[i] += h / 6 * (a[i] + 2 * c[i] + 2 * d[i] + e[i]);
  }
  return {s[0], s[2]};
}

double alpha_of(const PlaceLight& light) { return 2 * std::atan2(light.sin_half, light.cos_half); }

TEST(WormholePlaces, AreOnTheirRaysOnBothSides) {
  for (const Wormhole& w : {kEllis, kWide, kShort})
    for (const double from : {6.0, 0.7, 0.2, 0.0, -3.0})
      for (const double to : {9.0, 2.0, 0.3, -0.4, -5.0})
        for (const double psi : {1e-12, 0.02, 0.7, 2.5, 4.5}) {
          SCOPED_TRACE(testing::Message()
                       << w.lensing_width << ' ' << from << ' ' << to << ' ' << psi);
          const auto light = image_of_place(WormholePlaceView{w, from}, to, psi, 0);
          ASSERT_TRUE(light);
          const double long_for = (to - from) - light->null_time, alpha = alpha_of(*light);
          const Point at = followed(w, from, alpha, long_for);
          // Rays part by exp(psi), and the steps of the test err next to the mouth of a cylinder.
          const double within = (w == kEllis ? 1e-9 : 1e-6) * std::exp(psi);
          EXPECT_NEAR(at.l, to, within);
          EXPECT_NEAR(at.psi, psi, within);
          if (psi < 1e-3) continue;
          // Neighbouring rays at the same psi.
          const double h = 1e-4 * std::min({1.0, alpha, pi - alpha}) * std::exp(-psi);
          const auto l_at = [&](double by) {
            const Point next = followed(w, from, alpha + by, long_for);
            return next.l - (next.psi - psi) * light->slope;
          };
          const double rise = (l_at(h) - l_at(-h)) / (2 * h), r = w.radius(to);
          EXPECT_NEAR(light->solid_angle_per_area * w.radius(from) * std::abs(std::sin(psi)) * rise,
                      1, 1e-3);
          EXPECT_NEAR(light->angle_per_length * rise * light->angular_momentum / r, 1, 1e-3);
          EXPECT_NEAR(light->angle_per_psi * rise / -light->slope, 1, 1e-3);
        }
}

// Seen from far away on the axis a place shines as it does in flat space, over the sphere's area.
TEST(WormholePlaces, HaveTheLightOfFlatSpaceFarAway) {
  for (const double side : {1.0, -1.0}) {
    const double from = 2e6 * side, to = 1e6 * side, psi = 0.3;
    const auto light = image_of_place(WormholePlaceView{kEllis, from}, to, psi, 0);
    ASSERT_TRUE(light);
    const double apart = std::sqrt(5 - 4 * std::cos(psi)) * 1e6;
    EXPECT_NEAR(light->solid_angle_per_area * apart * apart, 1, 1e-6);
    EXPECT_NEAR(to - from - light->null_time, apart, 1e-6 * apart);
  }
}

// All light of a lamp goes somewhere: a sphere about it, on the other side, gets what enters the throat.
TEST(WormholePlaces, BeyondTheThroatHaveTheLightThatEntersIt) {
  const double lamp = 4, far = -50;
  // By reversal the solid angle per area is the same for light that goes the other way.
  double sum = 0;
  constexpr int kParts = 4000;
  const double edge = std::asin(1 / kEllis.radius(lamp));
  // Images of all orders on the far sphere, by psi beyond pi too.
  constexpr double kMost = 14;
  for (int k = 0; k < kParts; ++k) {
    const double psi = (k + 0.5) / kParts * kMost;
    const auto light = image_of_place(WormholePlaceView{kEllis, lamp}, far, psi, 0);
    ASSERT_TRUE(light);
    // An area at right angles to the light is the sphere's times the cosine of its fall.
    const double r = kEllis.radius(far), b = light->angular_momentum;
    const double upright = std::sqrt(1 - b * b / (r * r));
    sum += light->solid_angle_per_area * upright * r * r * std::abs(std::sin(psi)) * kMost / kParts;
  }
  EXPECT_NEAR(sum / (1 - std::cos(edge)), 1, 1e-3);
}

BodyMotion resting(double l, const V3d& direction) {
  return {[=](double tau) {
            return BodyPoint{direction, kEllis.radius(l), tau + l, 1, 0, V3d(0, 0, 0), l};
          },
          -kAlways, kAlways};
}

TEST(WormholeBodies, AreSeenThroughTheThroatAndAroundIt) {
  const WormholePlaceView view{kEllis, 3};
  const double angle = 0.4;
  const V3d direction(std::cos(angle), std::sin(angle), 0);
  for (const double l : {-5.0, 5.0})
    for (int order = 0; order < 4; ++order) {
      const auto image = image_of_body(view, 0, resting(l, direction), order, 0.01);
      ASSERT_TRUE(image) << l << ' ' << order;
      EXPECT_NEAR(image->frequency_ratio, 1, 1e-12);
      // What is on the other side is seen in the throat's disc.
      const double from_throat = std::acos(-image->direction.x);
      EXPECT_EQ(from_throat < std::asin(1 / kEllis.radius(3)), l < 0) << order;
      EXPECT_EQ(image->direction.y > 0, order % 2 == 0) << order;
      // v = t + l, and the observer has t = -3.
      const double long_for = -3 - image->proper_time;
      const Point at = followed(kEllis, 3, from_throat, long_for);
      EXPECT_NEAR(at.l, l, 1e-6 * std::exp(image->psi));
      EXPECT_NEAR(at.psi, image->psi, 1e-6 * std::exp(image->psi));
    }
}

// A body that comes straight towards the observer through the throat is blue by Doppler's factor.
TEST(WormholeBodies, HaveDopplersShift) {
  const WormholePlaceView view{kEllis, 8};
  const double speed = 0.6, gamma = 1.25;
  const BodyMotion motion{
      [=](double tau) {
        const double l = speed * gamma * tau - 20;
        return BodyPoint{
            V3d(1, 0, 0), kEllis.radius(l), gamma * tau + l, gamma, gamma * speed, V3d(0, 0, 0), l};
      },
      -kAlways, kAlways};
  for (const double now : {20.0, 40.0, 55.0}) {
    const auto image = image_of_body(view, now + 8, motion, 0, 0);
    ASSERT_TRUE(image);
    const bool comes = image->proper_time * speed * gamma - 20 < 8;
    EXPECT_NEAR(image->frequency_ratio, comes ? 2 : 0.5, 1e-9) << now;
    const double l = image->proper_time * speed * gamma - 20;
    EXPECT_NEAR(gamma * image->proper_time + std::abs(l - 8), now, 1e-8);
  }
}

}  // namespace
}  // namespace domefall
