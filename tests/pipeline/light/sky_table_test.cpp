#include "pipeline/light/sky_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/schwarzschild_zone.h"

namespace domefall {
namespace {

constexpr double kRadii[] = {1e-6, 1e-3, 0.05, 0.5, 1,   1.5, 1.999, 2 - 1e-9, 2,   2 + 1e-12,
                             2.5,  2.9,  3,    3.1, 6.0, 10,  30.0,  1e3,      1e5, 1e8};

struct TableCase {
  double r;
  Critical edge;
  bool outgoing = false;
};

std::vector<TableCase> table_cases() {
  std::vector<TableCase> all;
  for (double r : kRadii) {
    all.push_back({r, Critical::kFirst});
    if (r < 2) all.push_back({r, Critical::kSecond});
    if (r > 2) all.push_back({r, Critical::kSecond, true});
  }
  return all;
}

double exact_at(const TableCase& c, double x) {
  const double sign = c.edge == Critical::kFirst ? 1 : -1;
  return exact_azimuth(ray_off_edge(c.r, c.edge, sign * 4 * std::atan(x / 2), {c.outgoing, false}));
}

TEST(SkyTable, AgreesWithTheExactIntegralFromTheEdgeToTheFarEnd) {
  std::mt19937_64 random(7);
  for (const TableCase& c : table_cases()) {
    const SkyTable table(schwarzschild_zone(c.r, c.edge, c.outgoing));
    EXPECT_LE(table.node_count(), 1024u);
    std::uniform_real_distribution<double> decade(-13, 0);
    double worst = 0, where = 0, displaced = 0;
    for (int k = 0; k < 3000; ++k) {
      const double x = table.x_max() * std::pow(10, decade(random));
      const double error = std::abs(table.azimuth(x) - exact_at(c, x));
      if (error > worst) worst = error, where = x;
      displaced = std::max(displaced, error / std::max(1.0, table.slope(x)));
    }
    EXPECT_LT(worst, 1e-9) << "r=" << c.r << " edge " << static_cast<int>(c.edge) << " x=" << where;
    EXPECT_LT(displaced, 1e-10) << "r=" << c.r << " edge " << static_cast<int>(c.edge);
  }
}

TEST(SkyTable, ContinuesLogarithmicallyBelowItsRange) {
  const SkyTable table(schwarzschild_zone(6, Critical::kFirst));
  for (double x : {1e-16, 1e-20, 1e-30})
    EXPECT_NEAR(table.azimuth(x), exact_at({6, Critical::kFirst}, x), 1e-9);
}

TEST(SkyTable, SlopeIsTheDerivativeOfTheExactIntegral) {
  for (const TableCase& c : table_cases()) {
    const SkyTable table(schwarzschild_zone(c.r, c.edge, c.outgoing));
    for (double part : {1e-9, 1e-6, 1e-3, 0.03, 0.3, 0.9}) {
      const double x = part * table.x_max(), h = 1e-3 * x;
      // Four-point central difference in delta.
      const auto f = [&](double k) { return exact_at(c, x + k * h); };
      const double dx = (8 * (f(1) - f(-1)) - (f(2) - f(-2))) / (12 * h);
      const double expected = std::abs(dx) * (1 + x * x / 4) / 2;
      EXPECT_NEAR(table.slope(x), expected, 1e-7 * expected) << "r=" << c.r << " part=" << part;
    }
  }
}

TEST(SkyTable, InverseReturnsToTheSameRay) {
  std::mt19937_64 random(8);
  for (const TableCase& c : table_cases()) {
    const SkyTable table(schwarzschild_zone(c.r, c.edge, c.outgoing));
    std::uniform_real_distribution<double> turns(0, 25);
    for (int k = 0; k < 500; ++k) {
      const double phi = turns(random);
      const double x = table.distance(phi);
      EXPECT_NEAR(table.azimuth(x), phi, 1e-11 * (1 + phi)) << "r=" << c.r;
    }
  }
}

TEST(SkyTable, FallsMonotonicallyAwayFromTheEdge) {
  for (const TableCase& c : table_cases()) {
    const SkyTable table(schwarzschild_zone(c.r, c.edge, c.outgoing));
    EXPECT_TRUE(table.curve().is_monotone(table.x_max())) << "r=" << c.r;
    double previous = 1e300;
    for (double y = std::log(table.x_max()) - 40; y < std::log(table.x_max()); y += 0.003) {
      const double phi = table.azimuth(std::exp(y));
      ASSERT_LT(phi, previous) << "r=" << c.r << " y=" << y;
      previous = phi;
    }
  }
}

TEST(SkyTable, TheFarEndIsUndeflected) {
  for (const TableCase& c : table_cases()) {
    const SkyTable table(schwarzschild_zone(c.r, c.edge, c.outgoing));
    EXPECT_NEAR(table.azimuth(table.x_max()), 0, 1e-9) << c.r;
  }
}

}  // namespace
}  // namespace domefall
