#include "projections/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace domefall {
namespace {

using std::numbers::pi;

CameraDirection random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Imath::V3d v(normal(random), normal(random), normal(random));
  return {v.normalized()};
}

TEST(Domemaster, BottomIsTheFrontAndRightIsTheRightHand) {
  const Projection dome = Domemaster{4096};
  const PixelPosition front = pixel_of(dome, {{0, 1, 0}}).value();
  EXPECT_DOUBLE_EQ(front.i, 2048.5);
  EXPECT_DOUBLE_EQ(front.j, 4096.5);
  const PixelPosition right = pixel_of(dome, {{1, 0, 0}}).value();
  EXPECT_DOUBLE_EQ(right.i, 4096.5);
  EXPECT_DOUBLE_EQ(right.j, 2048.5);
}

// [Riazuelo] fig. LSO_plane: 45 degrees above the front rim is (2000, 3000) of 4000, rounded down.
TEST(Domemaster, FortyFiveDegreesUpTheFrontIsThePapersPixel) {
  const PixelPosition p = pixel_of(Domemaster{4000}, {{0, std::sqrt(0.5), std::sqrt(0.5)}}).value();
  EXPECT_EQ(std::floor(p.i), 2000);
  EXPECT_EQ(std::floor(p.j), 3000);
}

TEST(Stereographic, TheHorizontalEdgesAreHalfTheOpeningAngleAway) {
  const Projection flat = Stereographic{1280, 720, pi / 2};
  const CameraDirection edge = direction_at(flat, {1280.5, 360.5});
  EXPECT_NEAR(std::atan2(edge.v.x, edge.v.z), pi / 4, 1e-15);
  EXPECT_NEAR(edge.v.y, 0, 1e-15);
}

TEST(Projections, PixelToDirectionAndBackIsTheIdentity) {
  std::mt19937 random(1);
  for (const Projection& p :
       {Projection(Domemaster{8192}), Projection(Stereographic{1920, 1080, 2.0}),
        Projection(Stereographic{64, 64, 1e-9})}) {
    std::uniform_real_distribution<double> u(0.5, columns(p) + 0.5), v(0.5, rows(p) + 0.5);
    for (int k = 0; k < 2000; ++k) {
      const PixelPosition at{u(random), v(random)};
      const CameraDirection n = direction_at(p, at);
      EXPECT_NEAR(n.v.length(), 1, 4e-16);
      const PixelPosition back = pixel_of(p, n).value();
      // theta carries a relative error of a few epsilon; 8192 pixels of it are below 1e-11.
      EXPECT_NEAR(back.i, at.i, 1e-11);
      EXPECT_NEAR(back.j, at.j, 1e-11);
    }
  }
}

TEST(Projections, DirectionToPixelAndBackIsTheIdentityOverTheWholeSphere) {
  std::mt19937 random(2);
  for (const Projection& p :
       {Projection(Domemaster{4096}), Projection(Stereographic{1920, 1080, 2.0})}) {
    for (int k = 0; k < 2000; ++k) {
      const CameraDirection n = random_direction(random);
      const CameraDirection back = direction_at(p, pixel_of(p, n).value());
      EXPECT_LT((back.v - n.v).length(), 1e-14);
    }
  }
}

TEST(Projections, OnlyTheDirectionBehindHasNoImage) {
  EXPECT_FALSE(pixel_of(Domemaster{1024}, {{0, 0, -1}}));
  EXPECT_FALSE(pixel_of(Stereographic{100, 100, 1}, {{0, 0, -1}}));
  EXPECT_TRUE(pixel_of(Domemaster{1024}, {{1e-9, 0, -1}}));
}

TEST(Domemaster, PixelSolidAnglesSumToTheHalfSphere) {
  const Projection dome = Domemaster{512};
  double sum = 0;
  for (int j = 1; j <= 512; ++j)
    for (int i = 1; i <= 512; ++i) {
      const PixelPosition at{static_cast<double>(i), static_cast<double>(j)};
      if (is_inside(dome, at)) sum += pixel_solid_angle(dome, at);
    }
  // The rim is a staircase of pixels: its area is right to about S^(2/3) of S^2 pixels.
  EXPECT_NEAR(sum, 2 * pi, 2 * pi * 5e-4);
}

TEST(Projections, PixelSolidAngleIsTheProductOfTheAngularScales) {
  for (const Projection& p :
       {Projection(Domemaster{1000}), Projection(Stereographic{1000, 800, 2.5})}) {
    const PixelPosition at{123, 456};
    const double h = 1e-3;
    const Imath::V3d du =
        (direction_at(p, {at.i + h, at.j}).v - direction_at(p, {at.i - h, at.j}).v) / (2 * h);
    const Imath::V3d dv =
        (direction_at(p, {at.i, at.j + h}).v - direction_at(p, {at.i, at.j - h}).v) / (2 * h);
    const double expected = du.cross(dv).length();
    EXPECT_NEAR(pixel_solid_angle(p, at), expected, expected * 1e-8);
  }
}

TEST(Projections, HandednessPutsYDownTheImage) {
  for (const Projection& p :
       {Projection(Domemaster{100}), Projection(Stereographic{100, 100, 1})}) {
    EXPECT_GT(direction_at(p, {90, 50.5}).v.x, 0);
    EXPECT_GT(direction_at(p, {50.5, 90}).v.y, 0);
  }
}

// Rows that only touch the circle, odd and even sizes, and a flat picture.
TEST(Projections, ARowsColumnsAreThoseInsideAndItsDirectionsTheirs) {
  for (const Projection& p :
       {Projection(Domemaster{1}), Projection(Domemaster{2}), Projection(Domemaster{63}),
        Projection(Domemaster{512}), Projection(Stereographic{64, 40, 2.0})}) {
    for (int row = 0; row < rows(p); ++row) {
      const ColumnRange range = inside_columns(p, row);
      std::vector<CameraDirection> n(
          static_cast<std::size_t>(std::max(0, range.last - range.first + 1)));
      inside_directions(p, row, range, n.data());
      for (int i = 0; i < columns(p); ++i) {
        const PixelPosition at{i + 1.0, row + 1.0};
        const bool in_range = i >= range.first && i <= range.last;
        ASSERT_EQ(in_range, is_inside(p, at)) << "row " << row << " column " << i;
        if (!in_range) continue;
        const Imath::V3d& v = n[static_cast<std::size_t>(i - range.first)].v;
        EXPECT_LT((v - direction_at(p, at).v).length(), 1e-15);
      }
    }
  }
}

}  // namespace
}  // namespace domefall
