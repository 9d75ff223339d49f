#include "pipeline/spacetime/kruskal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace domefall {
namespace {

constexpr double kOutside[] = {2 * (1 + 1e-12), 2.000001, 2.5, 3, 10, 99.9, 100.1, 1e4, 1e6};
constexpr double kInside[] = {0.5, 1, 1.5, 1.999999, 2 * (1 - 1e-12)};
constexpr double kTimes[] = {0, 1.25, -300, 1e6};

// The bound of r: a rounding of U V, seen through dr/d(UV) = -4 exp(-r/2)/r, is at r = 1/2 a
// relative 6 epsilon of r - 2; t carries the rounding of its shift.
void expect_round_trip(Region region, double t, double r) {
  const KruskalPoint p = kruskal_point(region, t, r);
  ASSERT_TRUE(std::isfinite(p.u) && std::isfinite(p.v)) << r;
  EXPECT_EQ(kruskal_region(p.u, p.v), region) << region_name(region) << " " << r;
  EXPECT_NEAR((kruskal_radius(p) - 2) / (r - 2), 1, 4e-15 + 5e-16 / std::abs(r - 2)) << r;
  EXPECT_NEAR(kruskal_time(p), t, 1e-15 * (1 + std::abs(t))) << r;
}

TEST(Kruskal, RoundTripsInAllFourRegions) {
  for (double t : kTimes) {
    for (double r : kOutside)
      for (Region region : {Region::kI, Region::kIII}) expect_round_trip(region, t, r);
    for (double r : kInside)
      for (Region region : {Region::kII, Region::kIV}) expect_round_trip(region, t, r);
  }
}

TEST(Kruskal, RadiusLessTwoKeepsItsRelativeAccuracyAtTheHorizon) {
  for (double x : {1e-300, 1e-18, 1e-12, 1e-6, -1e-6, -1e-12, -1e-18, -1e-300}) {
    // The series of (x/2) exp(1 + x/2), independent of Lambert's function.
    const double product = -(x / 2) * std::exp(1 + x / 2);
    EXPECT_NEAR(radius_less_two(product) / x, 1, 1e-15) << x;
  }
}

TEST(Kruskal, BothHorizonsAreAtTwo) {
  EXPECT_EQ(kruskal_radius({1, 0, 0, 0}), 2);
  EXPECT_EQ(kruskal_radius({0, -1, 0, 0}), 2);
  EXPECT_EQ(kruskal_radius({0, 0, 0, 0}), 2);
}

TEST(Kruskal, TheSingularityIsAtUVOneAndNothingBeyond) {
  EXPECT_NEAR(radius_less_two(1), -2, 1e-7);
  EXPECT_TRUE(std::isnan(radius_less_two(1.0001)));
}

// A shift of t is the boost U -> U e^a, V -> V e^-a.
TEST(Kruskal, AShiftOfTimeIsABoost) {
  const KruskalPoint p = kruskal_point(Region::kI, 0, 2.7);
  const double a = 0.75;
  const KruskalPoint boosted{p.u * std::exp(a), p.v * std::exp(-a), 0, 0};
  EXPECT_NEAR(kruskal_time(boosted), 4 * a, 1e-14);
  EXPECT_NEAR(kruskal_radius(boosted), 2.7, 1e-14);
}

// u = t + r*, v = t - r* and [Riazuelo] eq. defU, defV, term by term.
TEST(Kruskal, AgreesWithTheDefinitionByTheTortoiseCoordinate) {
  for (double r : {0.7, 1.9, 2.2, 5.0}) {
    const double t = 0.3, tortoise = r + 2 * std::log(std::abs(r / 2 - 1));
    const KruskalPoint p = kruskal_point(r > 2 ? Region::kI : Region::kII, t, r);
    EXPECT_NEAR(p.u * std::exp(p.shift / 4) / std::exp((t + tortoise) / 4), 1, 1e-14);
    EXPECT_NEAR(std::abs(p.v) * std::exp(-p.shift / 4) / std::exp((tortoise - t) / 4), 1, 1e-14);
  }
}

}  // namespace
}  // namespace domefall
