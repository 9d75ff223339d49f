#include "pipeline/spacetime/schwarzschild.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

namespace domefall {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

constexpr double kRadii[] = {1e-12, 1e-6, 0.01, 0.5, 0.999, 1, 1.5, 1.9999, 2.0001, 3, 6, 1e3, 1e8};

TEST(Schwarzschild, TheCriticalImpactIsThreeRootsOfThree) {
  EXPECT_EQ(Schwarzschild::kCriticalImpact, std::sqrt(27.0));
}

TEST(Schwarzschild, TheSpeedOfFreeFallIsOneAtTheHorizon) {
  EXPECT_EQ(Schwarzschild::free_fall_speed(Schwarzschild::horizon()), 1);
  EXPECT_EQ(Schwarzschild::below_light_speed(Schwarzschild::horizon()), 0);
  EXPECT_EQ(Schwarzschild::lapse_squared(Schwarzschild::horizon()), 0);
}

TEST(Schwarzschild, AgreesWithFiftyDigits) {
  constexpr double kRoundings = 4 * std::numeric_limits<double>::epsilon();
  for (const double r : kRadii) {
    const Wide wide = r, s = sqrt(2 / wide);
    const auto error = [](double value, const Wide& exact) {
      return static_cast<double>(abs(value / exact - 1));
    };
    EXPECT_LT(error(Schwarzschild::free_fall_speed(r), s), kRoundings) << r;
    EXPECT_LT(error(Schwarzschild::below_light_speed(r), 1 - s), kRoundings) << r;
    EXPECT_LT(error(Schwarzschild::lapse_squared(r), 1 - 2 / wide), kRoundings) << r;
    const Wide star = wide + 2 * log(abs(wide / 2 - 1));
    // Beyond r = 1 its terms have opposite signs, and it vanishes at r = 2.557.
    const double size = r < 1 ? static_cast<double>(-star) : 1 + r;
    EXPECT_LT(abs(Schwarzschild::tortoise(r) - star), kRoundings * size) << r;
  }
}

// One double cannot name r = 2 + 1e-30; the distance that a Radius holds can.
TEST(Schwarzschild, KeepsItsDigitsNextToTheHorizon) {
  const Radius at(2, 1e-30, -1);
  EXPECT_DOUBLE_EQ(Schwarzschild::below_light_speed(at), 2.5e-31);
  EXPECT_DOUBLE_EQ(Schwarzschild::lapse_squared(at), 5e-31);
  EXPECT_DOUBLE_EQ(Schwarzschild::tortoise(at), 2 + 2 * std::log(5e-31));
}

TEST(Schwarzschild, IsFlatAtInfinity) {
  const double flat = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Schwarzschild::free_fall_speed(flat), 0);
  EXPECT_EQ(Schwarzschild::below_light_speed(flat), 1);
  EXPECT_EQ(Schwarzschild::lapse_squared(flat), 1);
}

}  // namespace
}  // namespace domefall
