#include "pipeline/light/white_hole_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "tests/pipeline/light/singularity_rays.h"

namespace domefall {
namespace {

using std::numbers::pi;

std::vector<Case> white_hole_cases() {
  std::vector<Case> all;
  for (const long double r :
       {1e-6L,     1e-3L,      0.05L,      0.5L,       1.0L,       1.7L,      1.999L,
        2 - 1e-9L, 2 - 1e-15L, 2.0L,       2 + 1e-15L, 2 + 1e-12L, 2 + 1e-6L, 2.5L,
        2.9L,      3 - 1e-6L,  3 - 1e-10L, 3.0L,       3 + 1e-6L,  3.1L,      6.0L,
        10.0L,     30.0L,      1e3L,       1e5L,       1e8L})
    for (const bool outgoing : {false, true}) all.push_back({Radius(r), outgoing});
  return all;
}

TEST(WhiteHoleTable, AgreesWithTheExactIntegral) {
  for (const Case& c : white_hole_cases()) {
    const WhiteHoleTable table(c.at, c.outgoing);
    EXPECT_LE(table.node_count(), 1024u) << name(c);
    Rays rays(c, 5);
    double worst = 0, displaced = 0;
    NullRay where = ray_at(c.at, 1);
    for (int k = 0; k < 3000; ++k) {
      const NullRay ray = rays.next();
      const auto place = table.place_of(ray);
      ASSERT_GE(place.s, 0) << name(c) << " alpha " << alpha_of(ray);
      const double error = std::abs(table.azimuth(place) - exact_azimuth(ray));
      if (error > worst) worst = error, where = ray;
      displaced = std::max(displaced, error / std::max(1.0, std::abs(table.slope(place))));
    }
    EXPECT_LT(worst, 1e-8) << name(c) << " alpha " << alpha_of(where) << " gaps " << where.gap_first
                           << " " << where.gap_second;
    EXPECT_LT(displaced, 1e-10) << name(c) << table.node_count() << " " << c.at.above_horizon;
  }
}

TEST(WhiteHoleTable, SlopeIsThatOfTheExactIntegral) {
  for (const Case& c : white_hole_cases()) {
    const WhiteHoleTable table(c.at, c.outgoing);
    Rays rays(c, 6);
    for (int k = 0; k < 300; ++k) {
      const NullRay ray = rays.next();
      if (ray.sin_half < 1e-13 || ray.cos_half < 1e-13) continue;  // as good as radial
      const double expected = exact_slope(ray), seen = table.slope(table.place_of(ray));
      // Where phi turns, at E = 0, the slope has no relative accuracy of its own.
      const double scale = std::abs(expected) + 1e-3 / (ray.sin_half * ray.cos_half);
      EXPECT_NEAR(seen, expected, 1e-6 * scale)
          << name(c) << " alpha " << alpha_of(ray) << " phi " << exact_azimuth(ray);
    }
  }
}

TEST(WhiteHoleTable, EveryRayIsAmongThoseOfItsAzimuth) {
  for (const Case& c : white_hole_cases()) {
    const WhiteHoleTable table(c.at, c.outgoing);
    Rays rays(c, 7);
    for (int k = 0; k < 300; ++k) {
      const NullRay ray = rays.next();
      const double phi = table.azimuth(table.place_of(ray));
      const auto found = table.rays_of(phi);
      ASSERT_EQ(found.count, c.at.above_horizon > 0 ? 1 : 2) << name(c) << " " << phi;
      double nearest = 1;
      for (int b = 0; b < found.count; ++b) {
        const NullRay& back = found.ray[static_cast<std::size_t>(b)];
        EXPECT_NEAR(table.azimuth(table.place_of(back)), phi, 1e-11 * (1 + phi)) << name(c);
        nearest = std::min(nearest, std::abs(std::sin((alpha_of(back) - alpha_of(ray)) / 2)));
      }
      // At the extremum an azimuth fixes its ray to the square root of its own rounding.
      const double slope = std::abs(table.slope(table.place_of(ray)));
      const double curvature = table.turn() ? std::abs(table.turn()->curvature) : 1;
      EXPECT_LT(nearest, 1e-10 + 1e-14 * (1 + phi) / slope + std::sqrt(1e-14 / curvature))
          << name(c) << " alpha " << alpha_of(ray);
    }
  }
}

TEST(WhiteHoleTable, ShowsNothingBeyondTheExtremum) {
  const WhiteHoleTable inside(1.2, false), white(1.2, true);
  const double half_turn = std::asin(0.2) + pi / 2;
  EXPECT_NEAR(inside.turn()->azimuth, 2 * pi - half_turn, 1e-9);
  EXPECT_NEAR(white.turn()->azimuth, half_turn, 1e-9);
  EXPECT_EQ(inside.rays_of(2 * pi - half_turn - 1e-6).count, 0);
  EXPECT_EQ(inside.rays_of(2 * pi - half_turn + 1e-6).count, 2);
  EXPECT_EQ(white.rays_of(half_turn - 1e-6).count, 2);
  EXPECT_EQ(white.rays_of(half_turn + 1e-6).count, 0);
}

// Every alpha that is seen, in order, closely at both ends.
std::vector<NullRay> fan(const Case& c) {
  std::vector<NullRay> rays;
  const bool inside = c.at.above_horizon <= 0 && !c.outgoing;
  const double low = tan_half_critical(c.at, Critical::kSecond),
               high = tan_half_critical(c.at, Critical::kFirst);
  if (!inside) {
    for (double u = -60; u < 60; u += 0.004)  // ln tan(alpha/2)
      rays.push_back(ray_of_tangent(c.at, std::exp(u), c.outgoing));
    return rays;
  }
  const double middle = std::sqrt(high / low) - 1;
  for (double u = -30; u < std::log(middle); u += 0.004)
    rays.push_back(ray_of_ratio(c.at, Critical::kSecond, std::exp(u), false));
  for (double u = std::log(middle); u > -30; u -= 0.004)
    rays.push_back(ray_of_ratio(c.at, Critical::kFirst, -std::exp(u) / (1 + std::exp(u)), false));
  return rays;
}

TEST(WhiteHoleTable, BranchesAreMonotone) {
  for (const Case& c : white_hole_cases()) {
    if (c.at.above_horizon == 0) continue;  // E = 0 is on the axis
    const WhiteHoleTable table(c.at, c.outgoing);
    // Proven interval by interval, but for those next to E = 0, where the slope vanishes.
    EXPECT_TRUE(table.curve().is_monotone(table.turn() ? 0.8 * table.curve().x_max() : HUGE_VAL))
        << name(c);
    // Along alpha: one direction outside, one change of it at E = 0 otherwise.
    int changes = 0, before = 0;
    for (const NullRay& ray : fan(c)) {
      if (origin_of(ray) != SkyRegion::kIV || circles_for_ever(ray)) continue;
      const double slope = table.slope(table.place_of(ray));
      ASSERT_TRUE(std::isfinite(slope)) << name(c) << " alpha " << alpha_of(ray);
      const int sign = slope > 0 ? 1 : -1;
      changes += before != 0 && sign != before;
      before = sign;
    }
    EXPECT_EQ(changes, table.turn() ? 1 : 0) << name(c);
  }
}

TEST(WhiteHoleTable, GoesOnByItsLawsBelowItsRange) {
  for (const Case& c : white_hole_cases()) {
    if (std::abs(c.at.above_horizon) < 1e-12) continue;  // the edges themselves are below 1e-12
    const WhiteHoleTable table(c.at, c.outgoing);
    const auto check = [&](const NullRay& ray) {
      if (origin_of(ray) != SkyRegion::kIV) return;
      EXPECT_NEAR(table.azimuth(table.place_of(ray)), exact_azimuth(ray), 1e-8) << name(c);
    };
    for (const double tiny : {1e-13, 1e-16, 1e-20})
      for (const double side : {-1, 1})
        for (const Critical edge : {Critical::kFirst, Critical::kSecond})
          check(ray_off_edge(c.at, edge, side * tiny, {c.outgoing, false}));
    for (const double tiny : {1e-15, 1e-40, 1e-100})
      for (const double t : {tiny, 1 / tiny}) check(ray_of_tangent(c.at, t, c.outgoing));
  }
}

}  // namespace
}  // namespace domefall
