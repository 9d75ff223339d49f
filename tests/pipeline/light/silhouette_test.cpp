// The edges of the skies for an observer in the rain frame: what the paper says of them, and their
// digits.
#include "pipeline/light/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "pipeline/light/null_ray.h"
#include "tests/sanitized.h"
#include "trajectories/observer_state.h"

namespace domefall {
namespace {

using std::numbers::pi;
using Wide = boost::multiprecision::cpp_bin_float_100;

const double kSqrt27 = std::sqrt(27.0);
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// ---- the truth, without the closed form ----

// tan(delta/2) of the ray with r sin(delta) = sign sqrt(27) (1 - s cos(delta)), [Riazuelo] eq.
// L_E_ff, found by bracketing delta.  At neither end of the bracket may the ray be critical.
Wide critical_tangent(const Wide& r, int sign, const Wide& low, const Wide& high) {
  const Wide s = sqrt(2 / r), b = sign * sqrt(Wide(27));
  const auto excess = [&](const Wide& delta) { return r * sin(delta) - b * (1 - s * cos(delta)); };
  const auto close = [](const Wide& a, const Wide& c) {
    return abs(c - a) <= abs(c) * Wide(1e-60);
  };
  std::uintmax_t steps = 2000;
  const auto [a, c] = boost::math::tools::toms748_solve(excess, low, high, close, steps);
  return tan((a + c) / 4);
}

const Wide kHalfTurn = boost::math::constants::pi<Wide>();

// The paper's own conditions: light of sky I at the edge is outgoing beyond r = 3, ingoing below
// it, and has E > 0; outside, the angle of k^r = 0 parts the two critical rays, inside that of E =
// 0.
Wide true_silhouette(const Wide& r) {
  const Wide s = sqrt(2 / r);
  if (r <= 2) return critical_tangent(r, 1, acos(1 / s), kHalfTurn);
  return r > 3 ? critical_tangent(r, 1, 0, acos(s)) : critical_tangent(r, 1, acos(s), kHalfTurn);
}

Wide true_other(const Wide& r) {
  const Wide s = sqrt(2 / r);
  if (r < 2) return -critical_tangent(r, -1, 0, acos(1 / s));
  return r > 3 ? critical_tangent(r, 1, acos(s), kHalfTurn) : critical_tangent(r, 1, 0, acos(s));
}

Wide whole(const Radius& at) {
  if (is_near(at.above_horizon)) return 2 + Wide(at.above_horizon);
  return is_near(at.above_light_circle) ? 3 + Wide(at.above_light_circle) : Wide(at.r);
}

// 1e-6 to 1e8, evenly in log r, and distances from r = 2 and r = 3 down to 1e-25, which no double r
// holds.
std::vector<Radius> radii() {
  std::vector<Radius> all;
  for (double e = -6; e <= 8; e += kSanitized ? 0.5 : 0.1) all.emplace_back(std::pow(10, e));
  for (double e = -25; e < -1; e += 1.5)
    for (const double d : {std::pow(10, e), -std::pow(10, e)}) {
      all.emplace_back(2 + d, d, d - 1);
      all.emplace_back(3 + d, d + 1, d);
    }
  return all;
}

template <class Real>
double relative_error(Real value, const Wide& truth) {
  return static_cast<double>(abs(Wide(value) / truth - 1));
}

TEST(Silhouette, HasFullRelativeAccuracyFromOneMillionthToAHundredMillion) {
  double worst = 0, worst_long = 0;
  for (const Radius& at : radii()) {
    const Wide truth = true_silhouette(whole(at));
    worst = std::max(worst, relative_error(tan_half_silhouette(at), truth));
    worst_long = std::max(worst_long, relative_error(tan_half_silhouette_long(at), truth));
  }
  EXPECT_LT(worst, 4 * kEpsilon);  // the header's figure
  EXPECT_LT(worst_long, 4 * std::numeric_limits<long double>::epsilon());
}

TEST(Silhouette, TheOtherCriticalRayIsAsAccurate) {
  double worst = 0, worst_long = 0;
  for (const Radius& at : radii()) {
    const Wide truth = true_other(whole(at));
    worst = std::max(worst, relative_error(tan_half_other_root(at), truth));
    worst_long = std::max(worst_long, relative_error(tan_half_other_root_long(at), truth));
    if (at.above_horizon < 0) {
      EXPECT_EQ(tan_half_region_three(at), -tan_half_other_root(at)) << at.r;
    }
  }
  EXPECT_LT(worst, 4 * kEpsilon);
  EXPECT_LT(worst_long, 4 * std::numeric_limits<long double>::epsilon());
}

// ---- the silhouette of sky I ----

TEST(Silhouette, AtTheHorizonCosDeltaIs23Over31) {
  EXPECT_NEAR(std::cos(silhouette_edge(2)), 23.0 / 31, 1e-15);
  EXPECT_NEAR(tan_half_silhouette(2), 2 / kSqrt27, kEpsilon);
  EXPECT_NEAR(2 * silhouette_edge(2) * 180 / pi, 84.2, 0.05);
}

// [Riazuelo] eq. E_k_crit: there the blueshift is strongest, 1 + z = 8/31.
TEST(Silhouette, AtTheHorizonItsLightIsShiftedBy23Over31) {
  EXPECT_NEAR(one_plus_z(ray_off_edge(2, Critical::kFirst, 0)), 1 - 23.0 / 31, 1e-15);
}

TEST(Silhouette, FillsHalfTheSkyAtTheSingularity) {
  EXPECT_NEAR(2 * silhouette_edge(1e-12), pi, 1e-5);
  // pi/2 - delta = sqrt(r/2) + O(r), of either edge.
  for (const double r : {1e-6, 1e-8, 1e-10, 1e-12}) {
    EXPECT_NEAR((pi / 2 - silhouette_edge(r)) / std::sqrt(r / 2), 1, 2 * std::sqrt(r)) << r;
    EXPECT_NEAR((pi / 2 - region_three_edge(r)) / std::sqrt(r / 2), 1, 2 * std::sqrt(r)) << r;
  }
}

TEST(Silhouette, FillsHalfTheSkyOfAStaticObserverAtThreeM) {
  const double s = std::sqrt(2.0 / 3), kappa = std::sqrt(1.0 / 3) / (1 + s);
  EXPECT_NEAR(2 * std::atan(tan_half_silhouette(3) / kappa), pi / 2, 1e-15);
}

// Synge's formula (MNRAS 131, 463, 1966), sin = sqrt(27) sqrt(1 - 2/r)/r, from the edge in rain by
// the half-angle law of aberration; below r = 3 the angle is obtuse.
TEST(Silhouette, IsSyngesForAStaticObserver) {
  for (const double r : {2.0001, 2.5, 2.999, 3.001, 4.0, 30.0, 1e4, 1e8}) {
    const double angle = 2 * std::atan(tan_half_silhouette(r) / kappa(r, {false, true}));
    EXPECT_NEAR(std::sin(angle) / (kSqrt27 * std::sqrt((r - 2) / r) / r), 1, 1e-14) << r;
    EXPECT_EQ(angle > pi / 2, r < 3) << r;
  }
}

TEST(Silhouette, FarAwayIsTheCriticalImpactParameterOverR) {
  EXPECT_NEAR(silhouette_edge(1e8) * 1e8, kSqrt27, 1e-3);
  // delta r/sqrt(27) = 1 - s + O(1/r), the aberration of the rain, which moves at s = sqrt(2/r).
  for (const double r : {1e4, 1e6, 1e8})
    EXPECT_NEAR(silhouette_edge(r) * r / kSqrt27, 1 - std::sqrt(2 / r), 3 / r) << r;
}

TEST(Silhouette, VanishesInFlatSpace) { EXPECT_EQ(silhouette_edge(kFlatSpace), 0); }

TEST(Silhouette, HasNoStepWhereItsFormulasMeet) {
  for (const double r : {2.0, 3.0}) {
    const double below = std::nextafter(r, 0), above = std::nextafter(r, 10);
    // d ln T/dr is about -1/2 at both: an ulp of r moves T by less than one of its own.
    const double here = tan_half_silhouette(r);
    EXPECT_NEAR(tan_half_silhouette(below) / here, 1, 4 * kEpsilon) << r;
    EXPECT_NEAR(tan_half_silhouette(above) / here, 1, 4 * kEpsilon) << r;
  }
  // It only shrinks with distance.
  double before = pi / 2;
  for (const Radius& at : radii()) {
    if (is_near(at.above_horizon) || is_near(at.above_light_circle)) continue;
    const double edge = silhouette_edge(at);
    EXPECT_LT(edge, before) << at.r;
    before = edge;
  }
}

// Where the rays beside the edge come from, on both sides of the horizon and of the light circle.
TEST(Silhouette, PartsSkyOneFromTheSingularityAtEveryRadius) {
  for (const double r : {0.01, 1.0, 1.999999, 2.0, 2.000001, 2.9, 3.0, 3.1, 30.0, 1e6})
    for (const double offset : {1e-3, 1e-9, 1e-14}) {
      // Towards the hole by half the way to region III at most.
      const double apart = r < 2 ? silhouette_edge(r) - region_three_edge(r) : silhouette_edge(r);
      const double step = std::min(offset * silhouette_edge(r), apart / 2);
      EXPECT_EQ(origin_of(ray_off_edge(r, Critical::kFirst, step)), SkyRegion::kI) << r;
      EXPECT_EQ(origin_of(ray_off_edge(r, Critical::kFirst, -step)), SkyRegion::kIV) << r;
    }
}

// ---- region III ----

TEST(RegionThree, IsAPointAtTheHorizonAndGrowsLinearly) {
  EXPECT_EQ(region_three_edge(2), 0);
  const double depth = 1e-5;
  EXPECT_NEAR(region_three_edge(2 - depth), 3 * std::sqrt(3.0) * depth / 8, 1e-9);
  // To full relative accuracy, where 2 - r is no difference of doubles.
  const double tiny = 1e-20;
  EXPECT_NEAR(region_three_edge({2, -tiny, -1}) / (3 * std::sqrt(3.0) * tiny / 8), 1, 1e-15);
}

TEST(RegionThree, FillsHalfTheSkyAtTheSingularity) {
  EXPECT_NEAR(2 * region_three_edge(1e-12), pi, 1e-5);
}

// The paper's tan^2(delta_III/2) < tan^2(mu/2) with cos(mu) = sqrt(r/2): its light has E < 0 up to
// the edge.  By the quadratic (1 + s) T^2 = s - 1 - (2r/sqrt 27) T <= s - 1, where the text prints
// >=.
TEST(RegionThree, LiesWhereTheEnergyIsNegative) {
  for (const double r : {1e-6, 0.01, 0.5, 1.0, 1.9, 1.999999}) {
    const double s = std::sqrt(2 / r), t = tan_half_region_three(r);
    EXPECT_LT((1 + s) * t * t, s - 1) << r;
    EXPECT_GT(std::cos(region_three_edge(r)), std::sqrt(r / 2)) << r;
    EXPECT_LT(invariants(ray_off_edge(r, Critical::kSecond, 0)).energy, 0) << r;
  }
}

// At rest in t inside the horizon both skies are caps of one size about opposite directions, with
// r tan(delta) = sqrt(27) sqrt(2/r - 1).
TEST(RegionThree, IsAsLargeAsSkyOneForAnObserverAtRestInT) {
  for (const double r : {1e-6, 0.01, 0.5, 1.0, 1.9, 1.999999}) {
    const double k = kappa(r, {false, true});
    const double one = pi - 2 * std::atan(tan_half_silhouette(r) / k);
    const double three = 2 * std::atan(tan_half_region_three(r) / k);
    const double expected = std::atan(kSqrt27 * std::sqrt((2 - r) / r) / r);
    EXPECT_NEAR(three / expected, 1, 4 * kEpsilon) << r;
    EXPECT_NEAR(one, expected, 2 * kEpsilon * pi) << r;
  }
}

// ---- where there is no edge ----

TEST(Silhouette, IsNoNumberWhereThereIsNoRadius) {
  for (const double r : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(std::isnan(silhouette_edge(r))) << r;
    EXPECT_TRUE(std::isnan(tan_half_silhouette(r))) << r;
    EXPECT_TRUE(std::isnan(tan_half_silhouette_long(r))) << r;
    EXPECT_TRUE(std::isnan(tan_half_other_root(r))) << r;
    EXPECT_TRUE(std::isnan(tan_half_other_root_long(r))) << r;
    EXPECT_TRUE(std::isnan(region_three_edge(r))) << r;
  }
}

TEST(RegionThree, IsNeverPositiveOutsideTheHorizon) {
  for (const double r : {std::nextafter(2.0, 3.0), 2.5, 3.0, 10.0, 1e8}) {
    EXPECT_LT(tan_half_region_three(r), 0) << r;
    EXPECT_LT(region_three_edge(r), 0) << r;
  }
}

}  // namespace
}  // namespace domefall
