#include "projections/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace domefall {
namespace {

using std::numbers::pi;

// A projection of each kind, with the extremes of their parameters.
const std::vector<Projection>& every_projection() {
  static const std::vector<Projection> all{Domemaster{8192},
                                           Stereographic{1920, 1080, 2.0},
                                           Stereographic{64, 64, 1e-9},
                                           Rectilinear{1920, 1080, 1.9},
                                           Rectilinear{640, 480, 3.0},
                                           Stereographic{720, 576, 1.6, 16. / 11},
                                           Rectilinear{720, 480, 1.5, 0.9},
                                           Fisheye{1024, 2000, 4, 0.25, 2},
                                           Fisheye{1024, 512, 3, 1, 0.5},
                                           Rectilinear{64, 64, 1e-9},
                                           Fisheye{4096, 4096, 7 * pi / 6, 0},
                                           Fisheye{4096, 3072, 1.1 * pi, 1},
                                           Fisheye{4096, 3001, pi, 0.25},
                                           Fisheye{2048, 2048, 2 * pi, 0},
                                           Equirectangular{8192},
                                           Cubemap{1024},
                                           Cubemap{33}};
  return all;
}

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
  for (const Projection& p : every_projection()) {
    std::uniform_real_distribution<double> u(0.5, columns(p) + 0.5), v(0.5, rows(p) + 0.5);
    for (int k = 0; k < 2000; ++k) {
      const PixelPosition at{u(random), v(random)};
      if (!is_inside(p, at)) continue;
      const CameraDirection n = direction_at(p, at);
      EXPECT_NEAR(n.v.length(), 1, 4e-16);
      const PixelPosition back = pixel_of(p, n).value();
      // Angles carry a few epsilon; 8192 pixels of them are below 1e-11.  A pixel that covers less
      // of the view, beside a pole or the back of a fisheye, is found as much less well.
      const double covered = pixel_solid_angle(p, at) / pixel_angle(p, at) / pixel_angle(p, at);
      EXPECT_NEAR(back.i, at.i, 1e-11 / covered) << projection_name(p);
      EXPECT_NEAR(back.j, at.j, 1e-11 / covered) << projection_name(p);
    }
  }
}

TEST(Projections, DirectionToPixelAndBackIsTheIdentityOverTheWholeSphere) {
  std::mt19937 random(2);
  for (const Projection& p : every_projection()) {
    if (field_of_view(p).value_or(1) < 1e-6) continue;  // whose pixels are beyond all bounds
    for (int k = 0; k < 2000; ++k) {
      const CameraDirection n = random_direction(random);
      const auto pixel = pixel_of(p, n);
      if (std::holds_alternative<Rectilinear>(p) && n.v.z <= 0) {
        EXPECT_FALSE(pixel);
        continue;
      }
      const CameraDirection back = direction_at(p, pixel.value());
      EXPECT_LT((back.v - n.v).length(), 2e-14) << projection_name(p);
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

// Against the differences of neighbouring directions.
TEST(Projections, TheMetricIsThatOfSmallSteps) {
  std::mt19937 random(3);
  for (const Projection& p : every_projection()) {
    if (field_of_view(p).value_or(1) < 1e-6) continue;  // whose differences are rounding
    std::uniform_real_distribution<double> u(1, columns(p)), v(1, rows(p));
    for (int k = 0; k < 200; ++k) {
      const PixelPosition at{std::floor(u(random)), std::floor(v(random))};
      const double h = 1e-2;
      const Imath::V3d du =
          (direction_at(p, {at.i + h, at.j}).v - direction_at(p, {at.i - h, at.j}).v) / (2 * h);
      const Imath::V3d dv =
          (direction_at(p, {at.i, at.j + h}).v - direction_at(p, {at.i, at.j - h}).v) / (2 * h);
      const PixelMetric m = pixel_metric(p, at);
      // The differences err by their rounding, and by h^2/6 of the third derivative.
      const double pixel = pixel_angle(p, at), error = pixel * (1e-13 / h + 1e-4 * pixel * pixel);
      EXPECT_NEAR(m.xx, du.dot(du), 2 * error) << projection_name(p);
      EXPECT_NEAR(m.xy, du.dot(dv), 2 * error) << projection_name(p);
      EXPECT_NEAR(m.yy, dv.dot(dv), 2 * error) << projection_name(p);
      EXPECT_NEAR(pixel_solid_angle(p, at), du.cross(dv).length(), 2 * error);
      // The largest angle is the root of the metric's larger eigenvalue.
      const double mean = (m.xx + m.yy) / 2, half = (m.xx - m.yy) / 2;
      EXPECT_NEAR(pixel, std::sqrt(mean + std::hypot(half, m.xy)), 1e-7 * pixel);
      EXPECT_LE(pixel, largest_pixel_angle(p) * (1 + 1e-12)) << projection_name(p);
    }
  }
}

TEST(Projections, ImagesOfTheWholeSphereHoldFourPiSteradians) {
  for (const Projection& p : {Projection(Equirectangular{256}), Projection(Cubemap{64}),
                              Projection(Fisheye{400, 400, 2 * pi, 0})}) {
    double sum = 0;
    for (int row = 0; row < rows(p); ++row) {
      const ColumnRange range = inside_columns(p, row);
      for (int i = range.first; i <= range.last; ++i)
        sum += pixel_solid_angle(p, {i + 1.0, row + 1.0});
    }
    EXPECT_NEAR(sum, 4 * pi, 4 * pi * 2e-4) << projection_name(p);
  }
}

TEST(Projections, HandednessPutsYDownTheImage) {
  for (const Projection& p :
       {Projection(Domemaster{100}), Projection(Stereographic{100, 100, 1}),
        Projection(Rectilinear{100, 100, 1}), Projection(Fisheye{100, 100, 4, 0})}) {
    EXPECT_GT(direction_at(p, {90, 50.5}).v.x, 0);
    EXPECT_GT(direction_at(p, {50.5, 90}).v.y, 0);
  }
}

void expect_at(const Projection& p, const Imath::V3d& n, double i, double j) {
  const PixelPosition at = pixel_of(p, {n}).value();
  EXPECT_NEAR(at.i, i, 1e-9) << projection_name(p);
  EXPECT_NEAR(at.j, j, 1e-9) << projection_name(p);
}

TEST(Equirectangular, TheFrontIsInTheMiddleTheZenithAboveAndTheBackAtBothEdges) {
  const Projection p = Equirectangular{400};
  EXPECT_EQ(rows(p), 200);
  expect_at(p, {0, 1, 0}, 200.5, 100.5);
  expect_at(p, {1, 0, 0}, 300.5, 100.5);
  expect_at(p, {-1, 0, 0}, 100.5, 100.5);
  EXPECT_NEAR(pixel_of(p, {{0, 0, 1}})->j, 0.5, 1e-9);
  EXPECT_NEAR(pixel_of(p, {{0, 0, -1}})->j, 200.5, 1e-9);
  expect_at(p, {-1e-12, -1, 0}, 0.5, 100.5);
  expect_at(p, {1e-12, -1, 0}, 400.5, 100.5);
  EXPECT_LT((direction_at(p, {450, 30}).v - direction_at(p, {50, 30}).v).length(), 1e-15);
}

TEST(Cubemap, ItsFacesAreRightLeftUpAndDownFrontBack) {
  const Projection p = Cubemap{100};
  EXPECT_EQ(columns(p), 300);
  EXPECT_EQ(rows(p), 200);
  expect_at(p, {1, 0, 0}, 50.5, 50.5);
  expect_at(p, {-1, 0, 0}, 150.5, 50.5);
  expect_at(p, {0, 0, 1}, 250.5, 50.5);
  expect_at(p, {0, 0, -1}, 50.5, 150.5);
  expect_at(p, {0, 1, 0}, 150.5, 150.5);
  expect_at(p, {0, -1, 0}, 250.5, 150.5);
  // Up the front from its middle, the front face ends where the upper one begins.
  expect_at(p, Imath::V3d(0, 1, 0.999).normalized(), 150.5, 150.5 - 49.95);
  expect_at(p, Imath::V3d(0, 0.999, 1).normalized(), 250.5, 50.5 + 49.95);
}

TEST(Fisheye, OfAHalfSphereIsTheDomemaster) {
  std::mt19937 random(4);
  const Projection fisheye = Fisheye{1024, 1024, pi, 0.5}, dome = Domemaster{1024};
  for (int k = 0; k < 100; ++k) {
    const CameraDirection n = random_direction(random);
    const PixelPosition a = pixel_of(fisheye, n).value(), b = pixel_of(dome, n).value();
    EXPECT_NEAR(a.i, b.i, 1e-12 * 1024);
    EXPECT_NEAR(a.j, b.j, 1e-12 * 1024);
  }
}

TEST(Fisheye, ATruncatedOneIsAWindowOfTheWhole) {
  const Projection whole = Fisheye{4096, 4096, 3.5, 0.5};
  for (const double cut_back : {0.0, 0.25, 1.0}) {
    const Projection window = Fisheye{4096, 3072, 3.5, cut_back};
    const double above = 1024 * cut_back;
    for (const PixelPosition at : {PixelPosition{1, 1}, {4096, 3072}, {700, 1500}}) {
      const PixelPosition same{at.i, at.j + above};
      EXPECT_LT((direction_at(window, at).v - direction_at(whole, same).v).length(), 1e-15);
      EXPECT_EQ(is_inside(window, at), is_inside(whole, same));
    }
  }
}

TEST(Rectilinear, StraightLinesStayStraight) {
  const Projection p = Rectilinear{800, 600, 2};
  const Imath::V3d a = direction_at(p, {10, 20}).v, b = direction_at(p, {790, 500}).v;
  const PixelPosition middle = pixel_of(p, {(a + b * 0.4).normalized()}).value();
  EXPECT_NEAR((middle.j - 20) / (middle.i - 10), 480.0 / 780, 1e-12);
  EXPECT_NEAR(std::atan2(direction_at(p, {800.5, 300.5}).v.x, direction_at(p, {800.5, 300.5}).v.z),
              1, 1e-15);
}

TEST(Projections, ARefinedOneShowsTheSame) {
  for (const Projection& p : every_projection()) {
    const Projection fine = refined(p, 3);
    EXPECT_EQ(columns(fine), 3 * columns(p));
    EXPECT_EQ(rows(fine), 3 * rows(p));
    // A pixel's middle is that of its nine.
    const PixelPosition at{11, 7}, same{3 * 11 - 1, 3 * 7 - 1};
    EXPECT_LT((direction_at(fine, same).v - direction_at(p, at).v).length(), 1e-14);
  }
}

TEST(Projections, OnlySomeHaveAFieldOfViewToChange) {
  for (const Projection& p : every_projection()) {
    const Projection other = with_field_of_view(p, 0.5);
    EXPECT_EQ(field_of_view(other), field_of_view(p) ? std::optional(0.5) : std::nullopt);
    EXPECT_EQ(columns(other), columns(p));
  }
}

// Rows that only touch the circle, odd and even sizes, and a flat image.
TEST(Projections, ARowsColumnsAreThoseInside) {
  for (const Projection& p :
       {Projection(Domemaster{1}), Projection(Domemaster{2}), Projection(Domemaster{63}),
        Projection(Domemaster{512}), Projection(Stereographic{64, 40, 2.0}),
        Projection(Rectilinear{64, 40, 2.0}), Projection(Fisheye{63, 41, 4, 0.3}),
        Projection(Fisheye{64, 8, 4, 1}), Projection(Fisheye{31, 60, 4, 0.3, 2}),
        Projection(Fisheye{64, 30, 4, 1, 0.5}), Projection(Equirectangular{64}),
        Projection(Cubemap{17})}) {
    for (int row = 0; row < rows(p); ++row) {
      const ColumnRange range = inside_columns(p, row);
      for (int i = 0; i < columns(p); ++i) {
        const PixelPosition at{i + 1.0, row + 1.0};
        const bool in_range = i >= range.first && i <= range.last;
        ASSERT_EQ(in_range, is_inside(p, at)) << "row " << row << " column " << i;
      }
    }
  }
}

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
  expect_size(with_sides(Domemaster{8}, 640, 480), 480, 480);
  expect_size(with_sides(Equirectangular{8}, 641, 480), 640, 320);
  expect_size(with_sides(Cubemap{8}, 640, 480), 639, 426);
  EXPECT_TRUE(has_free_shape(Fisheye{10, 10, 1, 0}));
  for (const Projection& p :
       {Projection(Domemaster{8}), Projection(Equirectangular{8}), Projection(Cubemap{8})})
    EXPECT_FALSE(has_free_shape(p)) << projection_name(p);
}

// [Riazuelo] eq. pix_j, rescaled along the vertical.
TEST(PixelAspect, RowsAreRescaledAndColumnsStay) {
  const Projection square = Stereographic{720, 576, 1.5},
                   wide = with_pixel_aspect(square, 16. / 11);
  const CameraDirection n{Imath::V3d(0.3, -0.2, 0.9).normalized()};
  const PixelPosition a = pixel_of(square, n).value(), b = pixel_of(wide, n).value();
  EXPECT_DOUBLE_EQ(b.i, a.i);
  EXPECT_DOUBLE_EQ(b.j - 288.5, (a.j - 288.5) * 16 / 11);
  EXPECT_DOUBLE_EQ(pixel_aspect(wide), 16. / 11);
  EXPECT_FALSE(keeps_circles(wide));
  EXPECT_TRUE(keeps_circles(square));
}

TEST(PixelAspect, IsThatOfProjectionsThatAreFreeInIt) {
  for (const Projection& p : kUsualProjections) {
    const bool free = may_have_pixel_aspect(p);
    EXPECT_EQ(free, projection_name(p) == "stereographic" || projection_name(p) == "rectilinear" ||
                        projection_name(p) == "fisheye");
    EXPECT_EQ(pixel_aspect(with_pixel_aspect(p, 0.75)), free ? 0.75 : 1);
  }
}

TEST(PixelAspect, PartsOfPixelsAreNearlySquare) {
  for (const double aspect : {0.5, 0.6, 0.7, 0.71, 0.9, 1.0, 12. / 11, 1.41, 1.42, 1.6, 2.0}) {
    const Projection p = Rectilinear{90, 80, 1, aspect};
    const PixelParts parts = parts_nearly_square(p);
    const Projection fine = divided(p, parts);
    EXPECT_EQ(columns(fine), 90 * parts.across);
    EXPECT_EQ(rows(fine), 80 * parts.down);
    EXPECT_LE(parts.across * parts.down, 2);
    EXPECT_LE(std::max(pixel_aspect(fine), 1 / pixel_aspect(fine)), std::numbers::sqrt2);
    // The corners of the image stay where they are.
    const auto corner = [](const Projection& q) {
      return direction_at(q, {columns(q) + 0.5, rows(q) + 0.5}).v;
    };
    EXPECT_LT((corner(p) - corner(fine)).length(), 1e-15);
  }
  EXPECT_EQ(pixel_aspect(divided(Rectilinear{90, 80, 1, 2}, {2, 1})), 1);
}

TEST(PixelAspect, OnAScreenImagesHaveTheProportionsOfTheirField) {
  expect_size(with_square_pixels(Stereographic{720, 576, 1, 16. / 11}), 720, 396);
  expect_size(with_square_pixels(Fisheye{100, 200, 3, 0.5, 2}), 100, 100);
  const Projection p = Rectilinear{720, 480, 1, 0.9};
  EXPECT_DOUBLE_EQ(screen_sides(p).x, 0.9);
  EXPECT_DOUBLE_EQ(screen_sides(p).y, 1);
  EXPECT_DOUBLE_EQ(shorter_side(p), 480);
  EXPECT_DOUBLE_EQ(shorter_side(Rectilinear{500, 800, 1, 2}), 400);
}

TEST(PixelAspect, TheCircleOfAFisheyeIsAsHighAsItIsWideOnTheScreen) {
  expect_size(with_sides(Fisheye{10, 10, 1, 0, 2}, 300, 900), 300, 600);
  const Projection p = Fisheye{300, 600, 3, 0.5, 2};
  EXPECT_TRUE(is_inside(p, {150.5, 0.6}));
  EXPECT_TRUE(is_inside(p, {300.4, 300.5}));
  EXPECT_FALSE(is_inside(p, {10, 10}));
  EXPECT_NEAR(std::acos(direction_at(p, {150.5, 0.5}).v.z), 1.5, 1e-12);
  EXPECT_NEAR(std::acos(direction_at(p, {0.5, 300.5}).v.z), 1.5, 1e-12);
}

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
