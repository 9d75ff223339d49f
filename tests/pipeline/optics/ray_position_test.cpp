#include "pipeline/optics/ray_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "pipeline/optics/ray_request.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

TEST(RayPosition, IsThatOfTheReferenceRows) {
  std::ifstream file(source_file("tests/reference/positions.csv"));
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("rain,")) continue;
    std::istringstream cells(line);
    std::string observer, r, delta, psi, origin, there;
    for (std::string* cell : {&observer, &r, &delta, &psi, &origin, &there})
      std::getline(cells, *cell, ',');
    const auto found = trace_position(
        ray_at_angle(TraceObserver::kRain, decimal_radius(r), std::stold(delta)), std::stod(psi));
    ASSERT_TRUE(found) << line;
    EXPECT_NEAR(*found / std::stod(there), 1, 1e-10) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 224);
}

TEST(RayPosition, OfARadialRayEndsAtOnceAndOfACriticalOneNever) {
  EXPECT_EQ(exact_position(ray_at(10, 0), 0), 10);
  EXPECT_FALSE(exact_position(ray_at(10, 0), 1e-9));
  for (const double r : {0.5, 2.0, 2.5, 3.0, 10.0})
    EXPECT_NEAR(exact_position(ray_off_edge(r, Critical::kFirst, 0), 200).value_or(0), 3, 1e-9);
}

}  // namespace
}  // namespace domefall
