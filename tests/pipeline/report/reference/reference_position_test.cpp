#include "pipeline/report/reference/reference_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_ray.h"
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
    const ReferenceRayPlace place = reference_position(request, std::stod(psi));
    EXPECT_NEAR(place.r / std::stod(there), 1, 1e-11) << line;
    // The closed form of the time shares no code with the series.
    const auto closed =
        trace_place(ray_at_angle(TraceObserver::kRain, decimal_radius(r), std::stold(delta)),
                    std::stod(psi), TraceMethod::kExact);
    ASSERT_TRUE(closed) << line;
    EXPECT_NEAR(closed->null_time, place.null_time, 1e-10 * (1 + std::abs(place.null_time)))
        << line;
  }
  EXPECT_EQ(rows, 224);
}

}  // namespace
}  // namespace domefall
