#include "pipeline/light/exact_azimuth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;
using std::numbers::pi_v;

// Every ray from the past singularity that turns back at E = 0, and those that just pass.
TEST(ExactAzimuth, AtZeroEnergyIsTheArcSineOfThePaper) {
  // [Riazuelo] sec. sec_Kruskal: arcsin(r - 1) + pi/2 seen from IV at E = 0, and what is left of
  // the whole turn of 2 pi seen from II.
  for (const double r : {1e-6, 0.01, 0.5, 1.0, 1.7, 1.999}) {
    const double half_turn = 2 * std::asin(std::sqrt(r / 2));  // the same without cancelling
    for (const bool outgoing : {false, true}) {
      const double phi = exact_azimuth(ray_at(r, pi_v<long double> / 2, {outgoing, true}));
      EXPECT_NEAR(phi, outgoing ? half_turn : 2 * pi - half_turn, 4e-15 * std::max(1.0, phi)) << r;
    }
  }
}

TEST(ExactAzimuth, OfARadialRayIsNothingAndOfACriticalOneEndless) {
  EXPECT_EQ(exact_azimuth(ray_at(10, 0)), 0);
  EXPECT_EQ(exact_azimuth(ray_at(1, 0)), 0);
  EXPECT_EQ(exact_azimuth(ray_at(0.5, 0, {true, false})), 0);
  for (const double r : {0.5, 2.0, 2.5, 3.0, 10.0})
    EXPECT_EQ(exact_azimuth(ray_off_edge(r, Critical::kFirst, 0)), HUGE_VAL);
  EXPECT_EQ(exact_azimuth(ray_off_edge(0.5, Critical::kSecond, 0)), HUGE_VAL);
  EXPECT_EQ(exact_azimuth(ray_off_edge(5, Critical::kSecond, 0, {true, false})), HUGE_VAL);
  // A critical ray that has yet to reach the light circle has come a finite way.
  EXPECT_LT(exact_azimuth(ray_off_edge(5, Critical::kSecond, 0)), pi);
}

TEST(ExactAzimuth, StaysFiniteForRaysAsGoodAsRadial) {
  for (const double r : {1e-6, 1.0, 2.0, 2.5, 1e8})
    for (const double delta : {1e-300, 1e-200, 1e-120, 1e-90, 1e-30}) {
      const double phi = exact_azimuth(ray_at(r, delta));
      EXPECT_TRUE(phi >= 0 && phi <= 3.15) << r << " " << delta << " " << phi;
    }
  // From the singularity phi grows with the cube root of the angle: no step where squares give out.
  const double above = exact_azimuth(ray_at(10, 1e-98)), below = exact_azimuth(ray_at(10, 1e-101));
  EXPECT_NEAR(above / below, 10, 1e-12);
}

}  // namespace
}  // namespace domefall
