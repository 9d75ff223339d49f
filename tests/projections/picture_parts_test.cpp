#include "projections/picture_parts.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

// Axes are right-handed, so that no face is mirrored.
TEST(PictureParts, ACubesAreRectilinearPicturesOfTheSameDirections) {
  const Projection p = Cubemap{64};
  ASSERT_EQ(picture_parts(p).size(), 6u);
  for (const PicturePart& part : picture_parts(p)) {
    EXPECT_EQ((part.axes[0].cross(part.axes[1]) - part.axes[2]).length(), 0);
    for (const double i : {1.0, 20.0, 64.0}) {
      const Imath::V3d v = direction_at(part.projection, {i, 9}).v;
      const Imath::V3d n = part.axes[0] * v.x + part.axes[1] * v.y + part.axes[2] * v.z;
      EXPECT_LT((n - direction_at(p, {part.column + i, part.row + 9.0}).v).length(), 1e-15);
    }
  }
}

TEST(PictureParts, OtherPicturesHaveNone) {
  EXPECT_TRUE(picture_parts(Equirectangular{64}).empty());
  EXPECT_TRUE(picture_parts(Domemaster{64}).empty());
}

}  // namespace
}  // namespace domefall
