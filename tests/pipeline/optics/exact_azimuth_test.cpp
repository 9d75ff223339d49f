#include "pipeline/optics/exact_azimuth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/optics/reference_rays.h"

namespace domefall {
namespace {

NullRay rain_ray(const ReferenceRay& row) {
  if (row.edge.empty()) return ray_at(Radius(row.r_decimal), row.delta);
  return ray_off_edge(Radius(row.r_decimal),
                      row.edge == "silhouette" ? Edge::kSilhouette : Edge::kRegionThree,
                      row.offset);
}

const char* name(Origin origin) {
  return origin == Origin::kSkyOne ? "I" : origin == Origin::kSkyThree ? "III" : "IV";
}

TEST(ExactAzimuth, AgreesWithFortyDigitsOnEveryRainRay) {
  int compared = 0;
  for (const ReferenceRay& row : reference_rays("rain")) {
    const NullRay ray = rain_ray(row);
    const std::string where = "r=" + std::to_string(row.r) + " delta=" + std::to_string(row.delta) +
                              " " + row.edge + " " + std::to_string(row.offset);
    ASSERT_EQ(name(origin_of(ray)), row.origin) << where;
    if (row.origin == "IV") continue;
    ++compared;
    const double phi = exact_azimuth(ray);
    EXPECT_NEAR(phi, row.phi, 1e-13 * std::max(1.0, row.phi)) << where;
    EXPECT_NEAR(one_plus_z(ray), row.one_plus_z, 1e-13 * row.one_plus_z) << where;
  }
  EXPECT_EQ(compared, 276);
}

}  // namespace
}  // namespace domefall
