// What any textbook or the paper says, in numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/light/null_ray.h"
#include "pipeline/light/traced_ray.h"
#include "trajectories/circular_orbit.h"

namespace domefall {
namespace {

using std::numbers::pi;

// [Riazuelo] eq. zmin_I: the strongest blueshift, at the edge of either sky, is
// 1 + z = r sin(delta)/(3 sqrt 3), which tends to r/(3 sqrt 3) at the singularity.
TEST(Redshift, IsLeastAtTheEdgesAndTendsToROverThreeRootThree) {
  for (const double r : {1e-6, 1e-4, 1e-2}) {
    double least = 1e9;
    for (const Edge edge : {Edge::kSilhouette, Edge::kRegionThree}) {
      double before = 0;
      for (double offset = 1e-13; offset < 1.4; offset *= 2) {
        RayRequest q{
            .at = Radius(r), .edge = edge, .offset = edge == Edge::kSilhouette ? offset : -offset};
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

// [Riazuelo] app. app_img: z = sqrt(2)/3 - 1 ahead and sqrt(2) - 1 behind on the last stable orbit.
TEST(CircularOrbitAtSixM, ShiftsAheadAndBehindAreThePapers) {
  const V3d celerity = CircularOrbit{6}.at(0).celerity;
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

// [Riazuelo] eq. zkin: with v = 0.6 and gamma = 1.25.  Light that is seen from the side,
// cos(alpha') = 0, is redder by gamma; light that comes from the side in the frame at rest,
// cos(alpha) = 0, is bluer by gamma, and seen from ahead.
TEST(Aberration, LightSeenFromTheSideIsRedAndLightFromTheSideBlue) {
  const double gamma = 1.25, v = 0.6;
  const V3d celerity(gamma * v, 0, 0);
  EXPECT_NEAR(1 / to_tetrad(celerity, {0, 1, 0}).frequency_ratio, 1 / gamma, 1e-15);
  const AberratedLight from_side = to_observer(celerity, {0, 1, 0});
  EXPECT_NEAR(from_side.frequency_ratio, gamma, 1e-15);
  EXPECT_NEAR(from_side.direction.x, v, 1e-15);
}

// After [Riazuelo] eq. zkin: the sky is bluer out to cos(alpha') = gamma v/(gamma + 1), which comes
// from cos(alpha) = -gamma v/(gamma + 1).
TEST(Aberration, BluerLightEndsAtOppositeCosinesInBothFrames) {
  for (const double v : {0.01, 0.3, 0.6, 0.9, 0.999}) {
    const double gamma = 1 / std::sqrt((1 - v) * (1 + v)), bound = gamma * v / (gamma + 1);
    const AberratedLight seen =
        to_observer(V3d(gamma * v, 0, 0), {-bound, std::sqrt((1 - bound) * (1 + bound)), 0});
    EXPECT_NEAR(seen.frequency_ratio, 1, 1e-13) << v;
    EXPECT_NEAR(seen.direction.x, bound, 1e-13) << v;
  }
}

// [Riazuelo] sec. sec_Kruskal: in region IV, at rest in t, b = r tan(delta)/sqrt(2/r - 1), which
// grows towards the horizon: what is seen there in any one direction but +-d/dt is the antipode.
TEST(RegionFour, ConvergesOnTheAntipodeNextToTheHorizon) {
  const double delta = pi / 4;
  const RadialFrame at_rest{true, true};
  double left_before = pi;
  for (const double depth : {1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-12}) {
    const NullRay ray = ray_at({2 - depth, -depth, -1 - depth}, delta, at_rest);
    const RayInvariants k = invariants(ray);
    const double b = (2 - depth) * std::tan(delta) / std::sqrt(depth / (2 - depth));
    // E is the mean of two numbers as large as L/sqrt(27), so it loses digits as b grows.
    EXPECT_NEAR(k.angular_momentum / std::abs(k.energy) / b, 1, 1e-14 + 1e-16 * b) << depth;
    const double left = pi - exact_azimuth(ray);
    EXPECT_LT(left, left_before) << depth;
    left_before = left;
  }
  EXPECT_LT(left_before, 1e-5);
}

// Far away the two bright images of a star behind the hole obey the lens equation of weak fields:
// the product of their distances from the hole, theta1 theta2, is the square of the Einstein ring's
// radius, theta_E^2 = 4/r, and the difference is the star's own.
TEST(Lensing, FarFromTheHoleTheTwoImagesObeyTheLensEquation) {
  const double r = 1e6;
  const HoleOptics optics = make_hole_optics(r, Tetrad::kRain, {});
  const double beta = 1e-3;
  const V3d source(-std::cos(beta), std::sin(beta), 0);
  const V3d one = image_of(optics.table_of(SkyRegion::kI), source, 0, 1e-9).direction.v;
  const V3d two = image_of(optics.table_of(SkyRegion::kI), source, 1, 1e-9).direction.v;
  const double theta1 = std::atan2(one.y, -one.x), theta2 = -std::atan2(two.y, -two.x);
  const double einstein2 = 4 / r;
  EXPECT_NEAR(theta1 * theta2 / einstein2, 1, 0.01);
  EXPECT_NEAR((theta1 - theta2) / beta, 1, 0.01);
}

}  // namespace
}  // namespace domefall
