#include "projections/cubemap_faces.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

// Axes are right-handed, so that no face is mirrored.
TEST(CubemapFaces, AreRectilinearImagesOfTheSameDirections) {
  const Projection p = Cubemap{64};
  ASSERT_EQ(cubemap_faces(p).size(), 6u);
  for (const CubemapFace& face : cubemap_faces(p)) {
    EXPECT_EQ((face.axes[0].cross(face.axes[1]) - face.axes[2]).length(), 0);
    for (const double i : {1.0, 20.0, 64.0}) {
      const Imath::V3d v = direction_at(face.projection, {i, 9}).v;
      const Imath::V3d n = face.axes[0] * v.x + face.axes[1] * v.y + face.axes[2] * v.z;
      EXPECT_LT((n - direction_at(p, {face.column + i, face.row + 9.0}).v).length(), 1e-15);
    }
  }
}

TEST(CubemapFaces, OtherProjectionsHaveNone) {
  EXPECT_TRUE(cubemap_faces(Equirectangular{64}).empty());
  EXPECT_TRUE(cubemap_faces(Domemaster{64}).empty());
}

}  // namespace
}  // namespace domefall
