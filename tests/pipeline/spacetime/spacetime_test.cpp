#include "pipeline/spacetime/spacetime.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

TEST(Spacetime, IsFlatUnlessAHoleIsGiven) {
  const Spacetime flat;
  EXPECT_TRUE(flat.is_flat());
  EXPECT_FALSE(flat.solar_masses());
  EXPECT_EQ(flat.seconds_per_m(), 1);
  EXPECT_GT(kFlatSpace, flat.horizon());
  EXPECT_EQ(flat.resting_celerity(kFlatSpace), 0);
  EXPECT_EQ(flat.gravitational_ratio(kFlatSpace), 1);
}

TEST(Spacetime, AsksTheHoleThatItIs) {
  const Spacetime hole = Schwarzschild{10};
  EXPECT_FALSE(hole.is_flat());
  EXPECT_EQ(hole.solar_masses(), 10);
  EXPECT_EQ(hole.seconds_per_m(), 10 * kSecondsPerSolarMass);
  EXPECT_EQ(hole.horizon(), 2);
  EXPECT_EQ(hole.light_circle(), 3);
  EXPECT_EQ(hole.last_stable_orbit(), 6);
  EXPECT_EQ(hole.lapse_squared(8), 0.75);
  EXPECT_EQ(hole.tortoise(5), Schwarzschild::tortoise(5));
}

// The speed of rest against free fall is that of free fall against rest.
TEST(Spacetime, RestAndFreeFallMoveAtTheSameSpeedAgainstEachOther) {
  const Spacetime hole = Schwarzschild{};
  for (const double r : {2.001, 3.0, 30.0}) {
    const double s = hole.static_time(r).along_r;
    EXPECT_NEAR(hole.resting_celerity(r) / (s / std::sqrt((1 - s) * (1 + s))), 1, 1e-12) << r;
  }
}

TEST(Spacetime, FlatSpaceSeesTheOwnSkyAlone) {
  for (const Tetrad tetrad : {Tetrad::kRain, Tetrad::kRainOfThree}) {
    const PerSky<bool> flat = Spacetime().seen_skies(Region::kI, tetrad, kFlatSpace),
                       inside = Spacetime(Schwarzschild{}).seen_skies(Region::kII, tetrad, 1);
    for (const SkyRegion sky : kExteriorSkies) {
      EXPECT_EQ(flat[sky], sky == own_sky(tetrad));
      EXPECT_TRUE(inside[sky]);
    }
  }
}

}  // namespace
}  // namespace domefall
