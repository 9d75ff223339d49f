// Orbits at the ends of long ways against tests/reference/far_ends.csv: 50-digit quadratures over r
// that begin at the end (make_far_ends.py).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/source_tree.h"
#include "tests/trajectories/named_orbit.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

// Relative.  Specified: 1e-12 for r; measured: 7e-15 for r, 1.4e-14 for times.
constexpr double kFarBound = 1e-13;

struct FarRow {
  std::string orbit, end, label;  // orbit: its factory and arguments
  std::string kind;
  double a = 0, b = 0, c = 0, since = 0, r = 0, null_gain = 0;
};

std::vector<FarRow> far_rows() {
  std::ifstream file(source_file("tests/reference/far_ends.csv"));
  std::vector<FarRow> all;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("kind", 0) == 0) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    cells.resize(8);
    const auto number = [&cells](std::size_t k) {
      return cells.at(k).empty() ? 0 : std::stod(cells.at(k));
    };
    const std::string orbit = cells[0] + ',' + cells[1] + ',' + cells[2] + ',' + cells[3];
    all.push_back({orbit, cells[4], line, cells[0], number(1), number(2), number(3), number(5),
                   number(6), number(7)});
  }
  return all;
}

Geodesic far_orbit(const FarRow& row) { return orbit_named(row.kind, row.a, row.b, row.c); }

ProperTime end_of(const FarRow& row, const Geodesic& orbit) {
  if (row.end == "past") return orbit.birth();
  if (row.end == "future") return orbit.death();
  if (row.end == "periastron") return orbit.time_at(orbit.innermost(), Leg::kOutward).value();
  return orbit.time_at(orbit.outermost(), Leg::kInward).value();
}

TEST(FarEnds, HaveTheRowsThatTheTestsCountOn) { EXPECT_GE(far_rows().size(), 300U); }

TEST(FarEnds, TheRadiusIsRightToTwelveDigits) {
  for (const FarRow& row : far_rows()) {
    const Geodesic orbit = far_orbit(row);
    EXPECT_NEAR(orbit.at(end_of(row, orbit) + row.since).r / row.r, 1, kFarBound) << row.label;
  }
}

TEST(FarEnds, TheTimeOfARadiusIsRightToTwelveDigitsOfTheTimeToTheEnd) {
  for (const FarRow& row : far_rows()) {
    const Geodesic orbit = far_orbit(row);
    const ProperTime end = end_of(row, orbit);
    const bool rises = row.end == "past" || row.end == "periastron";
    const auto tau = orbit.time_at(row.r, rises ? Leg::kOutward : Leg::kInward);
    ASSERT_TRUE(tau.has_value()) << row.label;
    // A rounding of r next to a turning point moves the time by a root of it.
    const bool turns = row.end == "periastron" || row.end == "apoastron";
    EXPECT_NEAR(double(*tau - end) / row.since, 1, turns ? 1e-6 : kFarBound) << row.label;
  }
}

// Between one row and the next of the same end.
TEST(FarEnds, TheNullTimeGainedIsRight) {
  const std::vector<FarRow> all = far_rows();
  int checked = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    const FarRow &from = all[k - 1], &to = all[k];
    if (from.orbit != to.orbit || from.end != to.end || to.null_gain == 0) continue;
    const Geodesic orbit = far_orbit(to);
    const ProperTime end = end_of(to, orbit);
    const DoubleDouble gain =
        orbit.at(end + to.since).null_time - orbit.at(end + from.since).null_time;
    EXPECT_NEAR(double(gain) / (to.null_gain - from.null_gain), 1, kFarBound) << to.label;
    ++checked;
  }
  EXPECT_GE(checked, 200);
}

// The closed form of the rain, on which the show's plain fall moves.
TEST(FarEnds, RadialInfallIsRightAtAnyDepth) {
  for (const double from_r : {1e9, 1e4, 30.0, 1e-3})
    for (double r = from_r; r >= 1e-6; r /= 3) {
      const RadialInfall fall{from_r};
      const Trajectory trajectory = fall;
      const ProperTime tau = proper_time_to(fall, r);
      EXPECT_NEAR(point_at(fall, tau).r / r, 1, 1e-15 * 4) << from_r << ' ' << r;
      const double left = std::sqrt(2.0) / 3 * std::pow(r, 1.5);
      if (r < from_r / 2) {
        EXPECT_NEAR(double(lifetime(trajectory) - tau) / left, 1, 1e-14) << from_r << ' ' << r;
      }
      EXPECT_EQ(time_at(trajectory, r, Leg::kInward).value(), tau);
    }
}

// Where one end's count meets the other's, half the way in time from both.
TEST(FarEnds, TheCountsMeetWithoutAStep) {
  for (const Geodesic& orbit :
       {fall_from_rest(1e8, 0), fall_from_rest(10, 3), fall_from_infinity(3.9, 1e6),
        kruskal_crossing(0.9999999), thrown_outside(1e9, -4.5e-5, 5e-9)}) {
    const double end = std::isinf(orbit.death())
                           ? double(*orbit.time_at(orbit.innermost(), Leg::kInward))
                           : orbit.death();
    double before = orbit.at(0).r;
    for (int k = 1; k < 2000; ++k) {
      const double r = orbit.at(end * k / 2000).r;
      EXPECT_LT(r, before) << orbit.energy() << ' ' << k;
      before = r;
    }
  }
}

TEST(FarEnds, ABoundOrbitsPeriastronIsTheSameAfterManyPeriods) {
  const Geodesic orbit = bound_by_turning_points(10, 1e9);
  const double first = double(orbit.time_at(11, Leg::kOutward).value());
  for (const double periods : {1.0, 3.0, 1e3, 1e5}) {
    const ProperTime later = exact_product(periods, orbit.radial_period());
    const ProperTime tau = orbit.time_at(11, Leg::kOutward, later).value();
    EXPECT_NEAR(orbit.at(tau).r / 11, 1, kFarBound) << periods;
    EXPECT_NEAR(double(tau - later) / first, 1, kFarBound) << periods;
    EXPECT_NEAR(orbit.at(later + first).r / 11, 1, kFarBound) << periods;
  }
}

}  // namespace
}  // namespace domefall
