#include "pipeline/report/reference/reference_position.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/source_tree.h"

namespace domefall {
namespace {

TEST(ReferencePosition, IsThatOfTheReferenceRows) {
  std::ifstream file(source_file("tests/reference/positions.csv"));
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("rain,") || ++rows % 8 != 0) continue;
    std::istringstream cells(line);
    std::string observer, r, delta, psi, origin, there;
    for (std::string* cell : {&observer, &r, &delta, &psi, &origin, &there})
      std::getline(cells, *cell, ',');
    const ReferenceRequest request{ReferenceObserver::kRain, Wide(r), Wide(delta), std::nullopt, 0};
    EXPECT_NEAR(reference_position(request, std::stod(psi)) / std::stod(there), 1, 1e-11) << line;
  }
  EXPECT_EQ(rows, 224);
}

}  // namespace
}  // namespace domefall
