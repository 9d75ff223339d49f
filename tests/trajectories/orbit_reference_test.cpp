// Orbits against tests/reference/orbits.csv: 50-digit quadratures over r itself (make_orbits.py),
// which share no parameter with the code.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_tree.h"
#include "tests/trajectories/named_orbit.h"

namespace domefall {
namespace {

// Measured: 2e-13 in all three, beyond the allowance for the rounding of tau.
constexpr double kBound = 1e-12;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Row {
  std::string kind, label;
  double a = 0, b = 0, c = 0;
  Leg leg = Leg::kInward;
  double periods = 0, tau = 0, r = 0, azimuth = 0, null_time = 0, energy = 0, momentum = 0;
};

std::vector<Row> rows() {
  std::ifstream file(source_file("tests/reference/orbits.csv"));
  std::vector<Row> all;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("kind", 0) == 0) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const auto number = [&cells](std::size_t k) {
      return cells.at(k).empty() ? 0 : std::stod(cells.at(k));
    };
    all.push_back({cells.at(0), line, number(1), number(2), number(3),
                   cells.at(4) == "in" ? Leg::kInward : Leg::kOutward, number(5), number(6),
                   number(7), number(8), number(9), number(10), number(11)});
  }
  return all;
}

Geodesic orbit_of(const Row& row) { return orbit_named(row.kind, row.a, row.b, row.c); }

double radial_speed(const Row& row) {
  const double l = row.momentum / row.r;
  return std::sqrt(std::abs(row.energy * row.energy - (1 - 2 / row.r) * (1 + l * l)));
}

// What a rounding of tau moves the orbit by: the best that any function of it can do.
struct Allowance {
  double r, azimuth, null_time;
};
Allowance allowance(const Row& row) {
  const double lost = 4 * kEpsilon * std::abs(row.tau), u = radial_speed(row);
  const double l = row.momentum / row.r;
  return {lost * u / row.r, lost * l / row.r, lost * (1 + l * l) / (row.energy + u)};
}

TEST(OrbitReference, HasTheRowsThatTheTestsCountOn) { EXPECT_GE(rows().size(), 200U); }

TEST(OrbitReference, RadiusAzimuthAndNullTimeAgreeToTwelveDigits) {
  for (const Row& row : rows()) {
    const OrbitPoint p = orbit_of(row).at(row.tau);
    const Allowance least = allowance(row);
    EXPECT_NEAR(p.r / row.r, 1, kBound + least.r) << row.label;
    EXPECT_NEAR(p.azimuth, row.azimuth,
                kBound * std::max(1.0, std::abs(row.azimuth)) + least.azimuth)
        << row.label;
    EXPECT_NEAR(double(p.null_time), row.null_time,
                kBound * std::max(1.0, std::abs(row.null_time)) + least.null_time)
        << row.label;
  }
}

TEST(OrbitReference, EnergyAndAngularMomentumAgree) {
  for (const Row& row : rows()) {
    const Geodesic orbit = orbit_of(row);
    EXPECT_NEAR(orbit.energy(), row.energy, 4 * kEpsilon * std::max(1.0, row.energy)) << row.label;
    EXPECT_NEAR(orbit.angular_momentum(), row.momentum, 8 * kEpsilon * row.momentum) << row.label;
  }
}

TEST(OrbitReference, TheTimeOfARadiusAgrees) {
  for (const Row& row : rows()) {
    const Geodesic orbit = orbit_of(row);
    const double after = row.periods > 0 ? row.tau - 1e-6 * std::abs(row.tau)
                                         : -std::numeric_limits<double>::infinity();
    const auto tau = orbit.time_at(row.r, row.leg, after);
    ASSERT_TRUE(tau.has_value()) << row.label;
    if (row.periods > 0 || !std::isfinite(orbit.radial_period())) {
      // A rounding of r moves tau by that over the speed.
      const double lost = kEpsilon * row.r / radial_speed(row);
      EXPECT_NEAR(double(*tau), row.tau, 1e-12 * std::max(1.0, std::abs(row.tau)) + 4 * lost)
          << row.label;
    }
  }
}

}  // namespace
}  // namespace domefall
