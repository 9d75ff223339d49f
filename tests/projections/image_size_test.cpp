#include "projections/image_size.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

void expect_size(const Projection& p, int width, int height) {
  EXPECT_EQ(columns(p), width) << projection_name(p);
  EXPECT_EQ(rows(p), height) << projection_name(p);
}

TEST(ImageSize, AWidthKeepsTheShape) {
  expect_size(with_width(Domemaster{4096}, 48), 48, 48);
  expect_size(with_width(Stereographic{1920, 1080, 1}, 480), 480, 270);
  expect_size(with_width(Rectilinear{1920, 1080, 1}, 48), 48, 27);
  expect_size(with_width(Fisheye{4096, 3072, 4, 1}, 48), 48, 36);
  expect_size(with_width(Equirectangular{8192}, 49), 48, 24);
  expect_size(with_width(Cubemap{1024}, 50), 48, 32);
  expect_size(with_width(Stereographic{10000, 10, 1}, 16), 16, 1);
}

TEST(ImageSize, SidesAreFreeWhereNoShapeIsGiven) {
  expect_size(with_sides(Rectilinear{10, 10, 1}, 640, 480), 640, 480);
  expect_size(with_sides(Fisheye{10, 10, 1, 0}, 640, 480), 640, 480);
  expect_size(with_sides(Fisheye{10, 10, 1, 0}, 480, 640), 480, 480);
  EXPECT_EQ(field_of_view(with_sides(Stereographic{10, 10, 1.5}, 20, 10)), 1.5);
  EXPECT_TRUE(has_free_shape(Fisheye{10, 10, 1, 0}));
  for (const Projection& p :
       {Projection(Domemaster{8}), Projection(Equirectangular{8}), Projection(Cubemap{8})})
    EXPECT_FALSE(has_free_shape(p)) << projection_name(p);
}

}  // namespace
}  // namespace domefall
