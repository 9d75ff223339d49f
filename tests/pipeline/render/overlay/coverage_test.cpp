#include "pipeline/render/overlay/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace domefall {
namespace {

struct DrawnCoverage {
  int width, height;
  std::vector<double> parts;
  double at(int x, int y) const { return parts[static_cast<std::size_t>(y * width + x)]; }
  double sum() const {
    double total = 0;
    for (const double part : parts) total += part;
    return total;
  }
};

DrawnCoverage drawn_coverage(const std::vector<ImagePolygon>& polygons, int width = 40,
                             int height = 40) {
  Coverage coverage(width, height);
  for (const ImagePolygon& polygon : polygons) coverage.add(polygon);
  DrawnCoverage drawn{width, height, std::vector<double>(static_cast<std::size_t>(width * height))};
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      drawn.parts[static_cast<std::size_t>(row * width + first) + k] = parts[k];
  });
  return drawn;
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

}  // namespace
}  // namespace domefall
