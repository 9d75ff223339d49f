#include "pipeline/render/stars/blackbody_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/colour/blackbody.h"

namespace domefall {
namespace {

TEST(BlackbodyTable, HasTheColoursOfBlackbodies) {
  for (double t = 1000; t < 1e10; t *= 1.0013) {
    const BlackbodyTable::Light seen = blackbody_table()(t);
    const WorkingRgb wanted = blackbody_colours().per_flux(t);
    EXPECT_NEAR(seen.luminance / luminance(wanted), 1, t < 3000 ? 5e-4 : 1e-4) << t;
    EXPECT_NEAR(seen.b, wanted.b, 1e-4 * std::max(wanted.r, wanted.b)) << t;
    EXPECT_LE(luminance(wanted), blackbody_table().most_luminance());
  }
  EXPECT_EQ(blackbody_table()(10).luminance, 0);
  EXPECT_EQ(blackbody_table()(0).r, 0);
}

}  // namespace
}  // namespace domefall
