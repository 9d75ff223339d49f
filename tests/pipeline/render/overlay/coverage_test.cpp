#include "pipeline/render/overlay/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "pipeline/base/lettering.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/stroke.h"

namespace domefall {
namespace {

// The part of each pixel that is covered, row by row.
std::vector<double> parts_of(const Coverage& coverage, int width, int height) {
  std::vector<double> all(static_cast<std::size_t>(width * height));
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    std::ranges::copy(parts, all.begin() + row * width + first);
  });
  return all;
}

constexpr int kSide = 40;

struct DrawnCoverage {
  std::vector<double> parts;
  double at(int x, int y) const { return parts[static_cast<std::size_t>(y * kSide + x)]; }
  double sum() const { return std::accumulate(parts.begin(), parts.end(), 0.0); }
};

DrawnCoverage drawn_coverage(const std::vector<ImagePolygon>& polygons) {
  Coverage coverage(kSide, kSide);
  for (const ImagePolygon& polygon : polygons) coverage.add(polygon);
  return {parts_of(coverage, kSide, kSide)};
}

ImagePolygon box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(Coverage, IsTheAreaOfEachPixelThatLiesWithin) {
  const DrawnCoverage p = drawn_coverage({box(3.25, 14.5, 9.75, 18.25)});
  EXPECT_DOUBLE_EQ(p.at(3, 14), 0.75 * 0.5);
  EXPECT_DOUBLE_EQ(p.at(6, 14), 0.5);
  EXPECT_DOUBLE_EQ(p.at(9, 18), 0.75 * 0.25);
  EXPECT_DOUBLE_EQ(p.at(5, 16), 1);
  EXPECT_EQ(p.at(2, 16), 0);
  EXPECT_EQ(p.at(10, 16), 0);
  EXPECT_NEAR(p.sum(), 6.5 * 3.75, 1e-9);
}

// A flat triangle, whose edges cross many pixels in a row: halves, quarters and trapezia by hand.
TEST(Coverage, IsExactAlongSlantingEdges) {
  const DrawnCoverage p = drawn_coverage({{{0, 0}, {8, 0}, {0, 2}}});
  const double expected[] = {1, 1, 1, 1, 0.875, 0.625, 0.375, 0.125};
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(p.at(x, 0), expected[x], 1e-12) << x;
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(p.at(x, 1), x < 4 ? 0.875 - 0.25 * x : 0, 1e-12) << x;
}

// What a drawing of few samples a pixel would miss: the sum does not tremble as a figure moves.
TEST(Coverage, HasTheSameLightWhereverAFigureLies) {
  for (int k = 0; k < 40; ++k) {
    const double x = 20 + k * 0.0713, y = 19 + k * 0.0391;
    ImagePolygon star;
    for (int corner = 0; corner < 10; ++corner) {
      const double r = corner % 2 ? 5.1 : 12.3, a = corner * std::numbers::pi / 5;
      star.push_back({x + r * std::cos(a), y + r * std::sin(a)});
    }
    // Corners are rounded to 1/4096 pixel.
    EXPECT_NEAR(drawn_coverage({star}).sum(), 5 * 5.1 * 12.3 * std::sin(std::numbers::pi / 5), 0.01)
        << k;
  }
}

TEST(Coverage, AHoleRunsAgainstItsOutline) {
  ImagePolygon hole = box(8, 8, 12, 12);
  std::reverse(hole.begin(), hole.end());
  const DrawnCoverage p = drawn_coverage({box(4, 4, 16, 16), hole});
  EXPECT_EQ(p.at(10, 10), 0);
  EXPECT_NEAR(p.sum(), 144 - 16, 1e-9);
  EXPECT_NEAR(drawn_coverage({box(4, 4, 16, 16), box(8, 8, 12, 12)}).sum(), 144, 1e-9) << "no hole";
}

TEST(Coverage, IsCutOffAtTheImagesEdges) {
  EXPECT_NEAR(drawn_coverage({box(-1e5, -1e5, 1e5, 1e5)}).sum(), 1600, 1e-6);
  EXPECT_NEAR(drawn_coverage({box(-7, 30, 2.5, 90)}).sum(), 25, 1e-9);
  EXPECT_NEAR(drawn_coverage({box(38.5, -3, 70, 2)}).sum(), 3, 1e-9);
  EXPECT_EQ(drawn_coverage({box(50, 3, 60, 8)}).sum(), 0);
  EXPECT_EQ(drawn_coverage({box(-20, 3, -1, 8)}).sum(), 0);
  // A slanting edge enters at the left and leaves at the right: all that is below the diagonal.
  EXPECT_NEAR(drawn_coverage({{{-40, -40}, {80, 80}, {-40, 80}}}).sum(), 800, 1e-6);
}

TEST(Coverage, LeavesOutWhatIsNoPlace) {
  EXPECT_EQ(drawn_coverage({{{3, 3}, {HUGE_VAL, 3}, {3, 9}}, {{3, 3}, {NAN, 3}, {3, 9}}}).sum(), 0);
}

using std::numbers::pi;

constexpr int kColumns = 256;
const Projection kSphere = Equirectangular{kColumns};

std::vector<double> turned_show(const std::vector<double>& pixels, int columns) {
  std::vector<double> result(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const std::size_t row = k / kColumns,
                      column = (k + static_cast<std::size_t>(columns)) % kColumns;
    result[row * kColumns + column] = pixels[k];
  }
  return result;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_NEAR(a[k], b[k], 0.02) << k / kColumns << " " << k % kColumns;
    sum += a[k];
  }
  EXPECT_GT(sum, 100);
}

V3d towards(double azimuth, double elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

std::vector<double> circle_at(double azimuth, double elevation, double radius) {
  Coverage coverage(kColumns, kColumns / 2);
  add_curve(ViewCircle{towards(azimuth, elevation), std::cos(radius), std::sin(radius)}, 3, kSphere,
            coverage);
  return parts_of(coverage, kColumns, kColumns / 2);
}

TEST(Seam, ACircleGoesOnBeyondIt) {
  // A turn by columns of the image, of which the seam is one.
  for (const int columns : {90, 128, 140})
    expect_same(turned_show(circle_at(0, 0.3, 0.5), columns),
                circle_at(2 * pi * columns / kColumns, 0.3, 0.5));
}

TEST(Seam, ACircleAroundAPoleIsALineThroughAllColumns) {
  for (const double azimuth : {0.0, 3.1})
    for (const double elevation : {1.4, -1.4}) {
      const std::vector<double> pixels = circle_at(azimuth, elevation, 0.6);
      for (std::size_t column = 0; column < kColumns; ++column) {
        double sum = 0;
        for (std::size_t row = 0; row < kColumns / 2; ++row) sum += pixels[row * kColumns + column];
        // It is 3 pixels wide, and wider where it is slanted.
        EXPECT_GT(sum, 2.9) << column;
        EXPECT_LT(sum, 4.5) << column;
      }
    }
}

std::vector<double> text_at(double azimuth, double elevation) {
  Coverage coverage(kColumns, kColumns / 2);
  const M33d axes(1, 0, 0, 0, 1, 0, 0, 0, 1);
  const TextSurface surface(axes, azimuth, elevation, 0.3);
  add_text(lettered("OHM", {}), surface, {0, 0}, kSphere, coverage);
  return parts_of(coverage, kColumns, kColumns / 2);
}

TEST(Seam, ATextGoesOnBeyondIt) {
  for (const int columns : {100, 128, 150})
    expect_same(turned_show(text_at(0, 0.2), columns), text_at(2 * pi * columns / kColumns, 0.2));
}

TEST(Seam, AnOutlineAroundAPoleIsFilledUpToIt) {
  Coverage coverage(kColumns, kColumns / 2);
  ImagePolygon outline;
  for (int k = 0; k < 64; ++k) {
    const auto pixel = pixel_of(kSphere, {towards(2 * pi * (k + 0.3) / 64, pi / 4)});
    outline.push_back(image_point(*pixel));
  }
  add_unwound(outline, kSphere, coverage);
  const std::vector<double> pixels = parts_of(coverage, kColumns, kColumns / 2);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    ASSERT_NEAR(std::abs(pixels[k]), k / kColumns < kColumns / 8 ? 1 : 0, 1e-3) << k;
}

TEST(Seam, OtherProjectionsHaveNone) {
  std::vector<ImagePoint> points{{1, 1}, {200, 5}, {3, 9}};
  unwind(Domemaster{256}, points);
  EXPECT_EQ(points[1].x, 200);
  EXPECT_EQ(winding(Domemaster{256}, points), 0);
  int copies = 0;
  each_copy(Domemaster{256}, [&](double shift) { copies += shift == 0 ? 1 : 100; });
  EXPECT_EQ(copies, 1);
}

}  // namespace
}  // namespace domefall
