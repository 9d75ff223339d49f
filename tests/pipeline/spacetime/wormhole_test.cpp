#include "pipeline/spacetime/wormhole.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace domefall {
namespace {

using Digits = boost::multiprecision::cpp_dec_float_50;
using Profile = Wormhole::Profile;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Digits exact_pi() { return boost::multiprecision::acos(Digits(-1)); }

// r - 1, dr/dl and d^2r/dl^2 by their definitions.
struct Shape {
  Digits above, slope, curvature;
};
Shape exact_shape(const Wormhole& w, double l) {
  const Digits far = abs(Digits(l));
  if (w.profile == Profile::kEllis) {
    const Digits r = sqrt(1 + far * far);
    return {r - 1, Digits(l) / r, 1 / (r * r * r)};
  }
  const Digits t = tan(exact_pi() / (2 * sqrt(Digits(2))));
  const Digits m = Digits(w.lensing_width) / (t * atan(t) - log(1 + t * t) / 2);
  const Digits y = far - Digits(w.length) / 2;
  if (y <= 0) return {0, 0, 0};
  const Digits x = 2 * y / (exact_pi() * m);
  // Beyond 1e15 the logarithm of 1 + x^2 is that of x^2 to 30 digits.
  return {m * (x * atan(x) - log(1 + x * x) / 2), (l < 0 ? -2 : 2) * atan(x) / exact_pi(),
          4 / (exact_pi() * exact_pi() * m * (1 + x * x))};
}

double error_of(double value, const Digits& exact) {
  if (exact == 0) return std::abs(value);
  return std::abs(static_cast<double>((Digits(value) - exact) / exact));
}

std::vector<Wormhole> shapes() {
  std::vector<Wormhole> all{{1, Profile::kEllis}};
  for (const double length : {0.0, 1e-6, 0.01, 10.0})
    for (const double width : {1e-6, 0.0143, 0.05, 2.86, 1000.0})
      all.push_back({1, Profile::kDngr, length, width});
  return all;
}

TEST(Wormhole, HasItsShapeToFourEpsilon) {
  double worst = 0;
  for (const Wormhole& w : shapes())
    for (const double beyond : {1e-12, 1e-7, 1e-4, 0.03, 0.7, 1.0, 5.0, 1e3, 1e8, 1e14})
      for (const double side : {-1.0, 1.0}) {
        const double l = side * (w.half_length() + beyond);
        const Shape exact = exact_shape(w, l);
        for (const double error :
             {error_of(w.above_throat(l), exact.above), error_of(w.slope(l), exact.slope),
              error_of(w.curvature(l), exact.curvature)}) {
          worst = std::max(worst, error);
          ASSERT_LE(error, 4 * kEpsilon) << l << " " << w.length << " " << w.lensing_width;
        }
      }
  RecordProperty("worst", std::to_string(worst / kEpsilon));
}

TEST(Wormhole, TellsTheDistanceOfARadius) {
  for (const Wormhole& w : shapes())
    for (const double above : {1e-30, 1e-12, 1e-5, 0.1, 1.0, 40.0, 1e6, 1e15}) {
      const double l = w.distance(above), y = w.beyond_mouth(l);
      if (y < 1e-3 * w.half_length()) continue;  // l - a has no digits there
      EXPECT_NEAR(w.above_throat(l) / above, 1, 1e-12) << w.length << " " << w.lensing_width;
    }
  // Without a cylinder every digit comes back.
  for (const double above : {1e-300, 1e-100, 1e-30, 1e-12, 1e-5, 0.1, 1.0, 1e15})
    for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 0, 0.05}})
      EXPECT_NEAR(w.above_throat(w.distance(above)) / above, 1, 8 * kEpsilon) << above;
}

TEST(Wormhole, ItsCylinderIsFlatAndItsLensingWidthReachesFortyFiveDegrees) {
  const Wormhole w{1, Profile::kDngr, 10, 2};
  for (const double l : {-5.0, -4.0, 0.0, 3.0, 5.0}) {
    EXPECT_EQ(w.radius(l), 1);
    EXPECT_EQ(w.slope(l), 0);
    EXPECT_EQ(w.curvature(l), 0);
    EXPECT_TRUE(w.in_cylinder(l));
  }
  EXPECT_FALSE(w.in_cylinder(5.1));
  EXPECT_NEAR(w.slope(w.distance(2)), std::numbers::sqrt2 / 2, 4 * kEpsilon);
  EXPECT_EQ(w.distance(0), 5);
}

// Far away there is flat space, with a length that is a little longer than the radius.
TEST(Wormhole, IsFlatFarAwayAndForLargeLengths) {
  for (const Wormhole& w : shapes()) {
    EXPECT_NEAR(w.radius(1e100) / 1e100, 1, 1e-12);
    EXPECT_NEAR(w.slope(-1e100), -1, kEpsilon);
    EXPECT_EQ(Wormhole::side(-1e-300), Region::kIII);
  }
  EXPECT_EQ(Wormhole::side(0), Region::kI);
}

TEST(Wormhole, TwoPlacesOfTheFlareDifferByItsGrowth) {
  double worst = 0;
  for (const double low : {1e-9, 1e-3, 0.5, 20.0, 1e7})
    for (const double part : {1e-12, 1e-6, 0.1, 3.0, 1e6}) {
      const double more = part * low;
      const Digits a = low, b = a + Digits(more);
      const Digits exact = (b * atan(b) - log(1 + b * b) / 2) - (a * atan(a) - log(1 + a * a) / 2);
      worst = std::max(worst, error_of(flare_growth(low, more), exact));
    }
  EXPECT_LE(worst, 16 * kEpsilon);
  EXPECT_EQ(flare_inverse(0), 0);
}

TEST(Wormhole, AnswersAsASpaceWithoutHorizon) {
  const Wormhole w{299792.458, Profile::kDngr, 3, 1};
  EXPECT_EQ(w.seconds_per_m(), 1);
  EXPECT_FALSE(Wormhole::solar_masses());
  EXPECT_EQ(w.tortoise(1), 1.5);
  EXPECT_GT(w.tortoise(2), 2.5);
  const PerSky<bool> seen = Wormhole::seen_skies(Region::kIII, Tetrad::kRain, 0, 1);
  EXPECT_TRUE(seen[SkyRegion::kI] && seen[SkyRegion::kIII]);
  EXPECT_NE(w.parameters(), (Wormhole{1, Profile::kDngr, 3, 2}).parameters());
  EXPECT_NE((Wormhole{1, Profile::kEllis}).parameters(), w.parameters());
}

}  // namespace
}  // namespace domefall
