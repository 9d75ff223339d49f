#include "pipeline/sources/disc/disc_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

std::vector<float> factors(const std::vector<PatternKind>& kinds,
                           const std::vector<PatternPlace>& places) {
  std::vector<float> out(places.size());
  DiscPattern(kinds).factors(places, out);
  return out;
}

std::vector<float> factors(const PatternKind& kind, const std::vector<PatternPlace>& places) {
  return factors(std::vector{kind}, places);
}

double factor(const PatternKind& kind, const PatternPlace& place) {
  return factors(kind, {place}).at(0);
}

std::vector<PatternPlace> ring(double r, double time, int count, double turned = 0,
                               double r_width = 0, double azimuth_width = 0) {
  std::vector<PatternPlace> places;
  for (int k = 0; k < count; ++k)
    places.push_back({r, turned + kTwoPi * k / count, time, r_width, azimuth_width});
  return places;
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += (a[k] - mean_a) * (b[k] - mean_b);
    aa += (a[k] - mean_a) * (a[k] - mean_a);
    bb += (b[k] - mean_b) * (b[k] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

std::vector<PatternPlace> scattered(int count, double least_r) {
  std::mt19937 random(4);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<PatternPlace> places;
  for (int k = 0; k < count; ++k)
    places.push_back({between(least_r, 40), between(-10, 10), between(-1e4, 1e4),
                      k % 3 == 0 ? 0 : between(0, 1), k % 4 == 0 ? 0 : between(0, 1)});
  return places;
}

TEST(DiscPattern, HasAMeanOfOneAroundEachRing) {
  for (const PatternKind& kind :
       {PatternKind(TurbulencePattern{}), PatternKind(TurbulencePattern{0.7, 12, 99}),
        PatternKind(SpotPattern{}), PatternKind(SpotPattern{7, 1, 3, 40})})
    for (const double r : {4.5, 6.0, 7.77, 12.0, 100.0, 9e5})
      for (const double time : {-300.0, 0.0, 1234.5, 1e9})
        for (const double width : {0.0, 0.01, 0.3, 4.0})
          // As many places as the noise has columns.
          EXPECT_NEAR(mean_of(factors(kind, ring(r, time, 4096, 0, width * r, width))), 1, 2e-5)
              << kind.index() << " " << r << " " << time << " " << width;
}

TEST(DiscPattern, IsNeverBelowZero) {
  for (const PatternKind& kind :
       {PatternKind(TurbulencePattern{}), PatternKind(RingPattern{2, 1, 0.02}),
        PatternKind(SpotPattern{8, 0, 0.7, 1000})})
    for (const float v : factors(kind, scattered(20000, 2))) ASSERT_GE(v, -1e-6f);
}

// Spots add the same light to any gas.
TEST(DiscPattern, OfSeveralKindsHasAMeanOfOne) {
  const TurbulencePattern turbulence;
  const SpotPattern spot{8, 1, 0.7, 20}, other{8.5, 3, 0.4, 9};
  const std::vector<PatternPlace> places = ring(8.2, 70, 4096);
  const std::vector<float> gas = factors(turbulence, places),
                           spots = factors({spot, other}, places),
                           all = factors({other, turbulence, spot}, places);
  EXPECT_NEAR(mean_of(all), 1, 2e-5);
  const float even = *std::min_element(spots.begin(), spots.end());
  for (std::size_t k = 0; k < places.size(); ++k)
    ASSERT_NEAR(all[k], spots[k] + even * (gas[k] - 1), 1e-5 * (1 + gas[k]) + 1e-5 * spots[k]);
  const RingPattern rings;
  const double factor_of_rings = factor(rings, places[0]);
  EXPECT_NEAR(mean_of(factors({turbulence, rings}, places)), factor_of_rings, 2e-5);
}

TEST(DiscPattern, GapsBetweenFilamentsGoDarkAndFilamentsBright) {
  const std::vector<float> values = factors(TurbulencePattern{}, scattered(20000, 7));
  EXPECT_LT(*std::min_element(values.begin(), values.end()), 0.1);
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 3);
}

TEST(DiscPattern, IsTheSameAlonePlacedAnywhereAndWithEveryInstructionSet) {
  const std::vector<PatternPlace> places = scattered(500, 3);
  const Simd before = simd_in_use();
  use_simd(Simd::kPortable);
  const std::vector<float> plain = factors(TurbulencePattern{}, places);
  for (std::size_t k = 0; k < places.size(); k += 7)
    EXPECT_EQ(factor(TurbulencePattern{}, places[k]), plain[k]);
  for (const Simd level : kEverySimd) {
    if (!processor_has(level)) continue;
    use_simd(level);
    EXPECT_EQ(factors(TurbulencePattern{}, places), plain) << name_of(level);
  }
  use_simd(before);
}

// Gas turns by Omega dt, and so does the pattern on it.
TEST(DiscPattern, FilamentsTurnWithTheGas) {
  for (const double r : {6.5, 9.0, 15.0}) {
    const double orbit = kTwoPi / GasOrbits().angular_velocity(r), after = 0.05 * orbit;
    const TurbulencePattern kind;
    const auto early = factors(kind, ring(r, 100, 1024));
    EXPECT_GT(correlation(early, factors(kind, ring(r, 100 + after, 1024, 0.05 * kTwoPi))), 0.95);
    EXPECT_LT(correlation(early, factors(kind, ring(r, 100 + after, 1024))), 0.5);
    // They live for an orbit.
    EXPECT_LT(correlation(early, factors(kind, ring(r, 100 + 2.5 * orbit, 1024, 0.5 * kTwoPi))),
              0.3);
  }
}

// No pop when a generation is born, no seam where azimuths begin, and none where rows end.
TEST(DiscPattern, ChangesSmoothlyWithTimeAndPlace) {
  const TurbulencePattern kind;
  std::vector<PatternPlace> in_time, in_azimuth, in_radius;
  for (int k = 0; k < 20000; ++k) {
    in_time.push_back({8, 1 + GasOrbits().angular_velocity(8) * k * 0.02, k * 0.02});
    in_azimuth.push_back({8, -kTwoPi / 2 + kTwoPi * (k - 10000) / 100000.0, 77});
    in_radius.push_back({6 + k * 1e-4, 2, 77});
  }
  // A step is 1/50 of the noise's texels in azimuth, and less in radius and time.
  const std::pair<std::vector<PatternPlace>, double> ways[] = {
      {in_time, 0.005}, {in_azimuth, 0.06}, {in_radius, 0.06}};
  for (const auto& [places, most] : ways) {
    const std::vector<float> values = factors(kind, places);
    for (std::size_t k = 1; k < values.size(); ++k)
      ASSERT_LT(std::abs(values[k] - values[k - 1]), most * (1 + values[k])) << k;
  }
}

// A pixel's factor is the mean over the pixel, as far as its shape is known.
TEST(DiscPattern, OfAPixelIsTheMeanOverIt) {
  constexpr int kParts = 8;
  const TurbulencePattern kind;
  for (const double width : {0.05, 0.15}) {
    std::vector<PatternPlace> whole, parts;
    for (int k = 0; k < 400; ++k) {
      const double r = 7 + 0.03 * k, azimuth = 2.4 * k, wide = width / r;
      whole.push_back({r, azimuth, 500, width, wide});
      for (int i = 0; i < kParts * kParts; ++i) {
        const double up = (i / kParts + 0.5) / kParts - 0.5;
        const double along = (i % kParts + 0.5) / kParts - 0.5;
        parts.push_back(
            {r + up * width, azimuth + along * wide, 500, width / kParts, wide / kParts});
      }
    }
    const std::vector<float> fine = factors(kind, parts);
    std::vector<float> means;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < kParts * kParts; ++i) sum += fine[k * kParts * kParts + i];
      means.push_back(static_cast<float>(sum / (kParts * kParts)));
    }
    EXPECT_GT(correlation(factors(kind, whole), means), 0.98) << width;
  }
}

TEST(DiscPattern, WhatIsFinerThanAPixelIsItsMean) {
  for (const PatternKind& kind :
       {PatternKind(TurbulencePattern{}), PatternKind(RingPattern{}), PatternKind(SpotPattern{})})
    EXPECT_NEAR(factor(kind, {9, 1, 50, 60, kTwoPi * 4}), 1, 0.02) << kind.index();
}

TEST(DiscPattern, AnotherSeedIsAnotherPattern) {
  const auto one = factors(TurbulencePattern{1, 2, 1}, ring(9, 0, 512)),
             other = factors(TurbulencePattern{1, 2, 2}, ring(9, 0, 512));
  EXPECT_LT(std::abs(correlation(one, other)), 0.4);
}

TEST(DiscPattern, PlungingGasIsEven) {
  for (const PatternPlace& place : ring(3.9, 10, 64))
    EXPECT_EQ(factor(TurbulencePattern{}, place), 1);
  EXPECT_NEAR(GasOrbits().angular_velocity(std::nextafter(6, 0)), GasOrbits().angular_velocity(6),
              1e-15);
  EXPECT_EQ(GasOrbits().angular_velocity(2), 0);
}

TEST(DiscPattern, RingsStandAtTheirSpacingAndDriftInwards) {
  const RingPattern rings{2, 0.8, 0.02};
  EXPECT_NEAR(factor(rings, {10, 0.3, 0}), 1.8, 1e-6);
  EXPECT_NEAR(factor(rings, {11, 2.3, 0}), 0.2, 1e-6);
  EXPECT_NEAR(factor(rings, {9, 0.3, 50}), 1.8, 1e-6);  // it came from 10
  double sum = 0;
  for (int k = 0; k < 100; ++k) sum += factor(rings, {10 + 0.02 * k, 0, 3.3});
  EXPECT_NEAR(sum / 100, 1, 1e-6);
}

TEST(DiscPattern, TheSpotFollowsItsOrbit) {
  const SpotPattern spot{10, 0.5, 0.5, 6};
  const double period = kTwoPi * std::pow(10, 1.5);
  const double over = factor(spot, {10, 0.5 + 3, 0});
  EXPECT_NEAR(factor(spot, {10, 0.5, 0}) / over, 6, 1e-5);
  EXPECT_NEAR(factor(spot, {10, 0.5 - kTwoPi, 7 * period}) / over, 6, 1e-5);
  EXPECT_NEAR(factor(spot, {10, 0.5 + kTwoPi / 4, period / 4}) / over, 6, 1e-5);
  // A standard deviation along the radius, and along the orbit.
  EXPECT_NEAR(factor(spot, {10.5, 0.5, 0}) / factor(spot, {10.5, 3.5, 0}), 1 + 5 * std::exp(-0.5),
              1e-4);
  EXPECT_NEAR(factor(spot, {10, 0.5 + 0.05, 0}), (1 + 5 * std::exp(-0.5)) * over, 1e-4);
}

}  // namespace
}  // namespace domefall
