// What any textbook or the paper says, in numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/silhouette.h"
#include "pipeline/optics/traced_ray.h"
#include "trajectories/circular_orbit.h"

namespace domefall {
namespace {

using std::numbers::pi;

TEST(Silhouette, AtTheHorizonCosDeltaIs23Over31) {
  EXPECT_NEAR(std::cos(silhouette_edge(2)), 23.0 / 31, 1e-15);
  EXPECT_NEAR(2 * silhouette_edge(2) * 180 / pi, 84.2, 0.05);
}

TEST(Silhouette, FillsHalfTheSkyAtTheSingularity) {
  EXPECT_NEAR(2 * silhouette_edge(1e-12), pi, 1e-5);
}

TEST(Silhouette, FillsHalfTheSkyOfAStaticObserverAtThreeM) {
  const double s = std::sqrt(2.0 / 3), kappa = std::sqrt(1.0 / 3) / (1 + s);
  EXPECT_NEAR(2 * std::atan(tan_half_silhouette(3) / kappa), pi / 2, 1e-15);
}

TEST(Silhouette, FarAwayIsTheCriticalImpactParameterOverR) {
  EXPECT_NEAR(silhouette_edge(1e8) * 1e8, std::sqrt(27.0), 1e-3);
}

TEST(Silhouette, VanishesInFlatSpace) { EXPECT_EQ(silhouette_edge(kFlatSpace), 0); }

TEST(RegionThree, IsAPointAtTheHorizonAndGrowsLinearly) {
  EXPECT_EQ(region_three_edge(2), 0);
  const double depth = 1e-5;
  EXPECT_NEAR(region_three_edge(2 - depth), 3 * std::sqrt(3.0) * depth / 8, 1e-9);
}

TEST(RegionThree, FillsHalfTheSkyAtTheSingularity) {
  EXPECT_NEAR(2 * region_three_edge(1e-12), pi, 1e-5);
}

// [Riazuelo] sec. on region III: the strongest blueshift, at the edge of either sky, is
// 1 + z = r sin(delta)/(3 sqrt 3), which tends to r/(3 sqrt 3) at the singularity.
TEST(Redshift, IsLeastAtTheEdgesAndTendsToROverThreeRootThree) {
  for (const double r : {1e-6, 1e-4, 1e-2}) {
    double least = 1e9;
    for (const Edge edge : {Edge::kSilhouette, Edge::kRegionThree}) {
      double before = 0;
      for (double offset = 1e-13; offset < 1.4; offset *= 2) {
        RayRequest q;
        q.at = Radius(r);
        q.edge = edge;
        q.offset = edge == Edge::kSilhouette ? offset : -offset;
        const double now = trace_ray(q, TraceMethod::kExact).one_plus_z;
        EXPECT_GT(now, before) << "1 + z grows away from the edge";
        before = now;
        least = std::min(least, now);
      }
    }
    EXPECT_NEAR(least / (r / (3 * std::sqrt(3.0))), 1, 3 * std::sqrt(r)) << r;
  }
}

// One-plus-z of sky I seen by an observer with this celerity along m (boosted tetrad).
double one_plus_z_along(double r, const V3d& celerity, const V3d& m) {
  const AberratedLight seen = to_tetrad(celerity, m);
  return (1 + std::sqrt(2 / r) * seen.direction.x) * seen.frequency_ratio;
}

// [Riazuelo] app_img: z = sqrt(2)/3 - 1 ahead and sqrt(2) - 1 behind on the last stable orbit.
TEST(CircularOrbitAtSixM, ShiftsAheadAndBehindAreThePapers) {
  const V3d celerity = point_at(CircularOrbit{6}, 0).celerity;
  // Ahead and behind are the extremes of 1 + z over the sky.
  double least = 1e9, most = 0;
  for (int k = 0; k < 200000; ++k) {
    const double a = 2 * pi * k / 200000;
    const double z1 = one_plus_z_along(6, celerity, {std::cos(a), 0, std::sin(a)});
    least = std::min(least, z1), most = std::max(most, z1);
  }
  EXPECT_NEAR(least, std::sqrt(2.0) / 3, 1e-9);
  EXPECT_NEAR(most, std::sqrt(2.0), 1e-9);
}

TEST(StaticObserver, SeesOneBlueshiftOverTheWholeSky) {
  for (double r : {2.5, 3.0, 4.0, 30.0}) {
    const V3d celerity(std::sqrt(2 / (r - 2)), 0, 0);
    for (double a : {0.1, 1.0, 2.0, 3.0})
      EXPECT_NEAR(one_plus_z_along(r, celerity, {std::cos(a), std::sin(a), 0}),
                  std::sqrt(1 - 2 / r), 1e-14);
  }
}

TEST(Aberration, ThereAndBackIsTheIdentityAtAnyLorentzFactor) {
  for (double speed : {0.0, 1e-9, 0.3, 10.0, 1e6}) {
    const V3d celerity = V3d(0.48, -0.6, 0.64) * speed;
    for (const V3d& raw :
         {V3d(1, 0, 0), V3d(0.48, -0.6, 0.64), V3d(-0.48, 0.6, -0.64), V3d(0.1, 0.9, -0.3)}) {
      const V3d m = raw.normalized();
      const AberratedLight there = to_tetrad(celerity, m);
      EXPECT_NEAR(there.direction.length(), 1, 1e-14);
      const AberratedLight back = to_observer(celerity, there.direction);
      // A direction behind a fast observer is spread over the whole sky: what is lost is the
      // rounding of the unit vector, magnified by the frequency ratio.
      const double magnified = std::max(there.frequency_ratio, 1 / there.frequency_ratio);
      EXPECT_LT((back.direction - m).length(), 1e-15 * magnified + 1e-15) << speed;
      EXPECT_NEAR(back.frequency_ratio * there.frequency_ratio, 1,
                  1e-9 + 1e-16 * magnified * magnified)
          << speed;
    }
  }
}

// [Riazuelo] eq. nprime_aber, in its textbook form, where that is well conditioned.
TEST(Aberration, AgreesWithThePapersFormula) {
  const V3d v(0.1, 0.5, -0.3);
  const double gamma = 1 / std::sqrt(1 - v.dot(v));
  const V3d n = V3d(0.3, -0.2, 0.7).normalized();
  const double vn = v.dot(n);
  const V3d expected = (n + v * (gamma * (1 + gamma / (gamma + 1) * vn))) / (gamma * (1 + vn));
  const AberratedLight seen = to_observer(v * gamma, n);
  EXPECT_LT((seen.direction - expected).length(), 1e-15);
  EXPECT_NEAR(seen.frequency_ratio, gamma * (1 + vn), 1e-15);
}

}  // namespace
}  // namespace domefall
