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
    const PerSky<bool> flat = Spacetime().seen_skies(Region::kI, tetrad, 0, kFlatSpace),
                       inside = Spacetime(Schwarzschild{}).seen_skies(Region::kII, tetrad, 0, 1);
    for (const SkyRegion sky : kExteriorSkies) {
      EXPECT_EQ(flat[sky], sky == own_sky(tetrad, 0));
      EXPECT_EQ(inside[sky], sky != SkyRegion::kNext);
    }
  }
}

TEST(Spacetime, EveryOtherUniverseHasTheNextSky) {
  const Spacetime hole = ChargedHole(1, 0.5L);
  for (const int universe : {-1, 0, 1, 2, 3}) {
    const SkyRegion one = own_sky(Tetrad::kRain, universe);
    EXPECT_EQ(one, universe % 2 == 0 ? SkyRegion::kI : SkyRegion::kNext) << universe;
    EXPECT_EQ(own_sky(Tetrad::kOutgoing, universe), one);
    EXPECT_EQ(own_sky(Tetrad::kRainOfThree, universe), SkyRegion::kIII);
    const PerSky<bool> between = hole.seen_skies(Region::kII, Tetrad::kRain, universe, 1);
    EXPECT_TRUE(between[one] && between[SkyRegion::kIII]) << universe;
  }
}

}  // namespace
}  // namespace domefall
