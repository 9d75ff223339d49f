#include "pipeline/render/overlay/seam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/lettering/lettering.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/stroke.h"
#include "pipeline/render/overlay/text_surface.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kWidth = 256;
const Projection kSphere = Equirectangular{kWidth};

// The part of each pixel that is covered, row by row.
std::vector<double> pixels_of(const Coverage& coverage) {
  std::vector<double> all(static_cast<std::size_t>(kWidth) * kWidth / 2);
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      all[static_cast<std::size_t>(row * kWidth + first) + k] += parts[k];
  });
  return all;
}

std::vector<double> turned_show(const std::vector<double>& pixels, int columns) {
  std::vector<double> result(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const std::size_t row = k / kWidth, column = (k + static_cast<std::size_t>(columns)) % kWidth;
    result[row * kWidth + column] = pixels[k];
  }
  return result;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ASSERT_NEAR(a[k], b[k], 0.02) << k / kWidth << " " << k % kWidth;
    sum += a[k];
  }
  EXPECT_GT(sum, 100);
}

V3d towards(double azimuth, double elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

std::vector<double> circle_at(double azimuth, double elevation, double radius) {
  Coverage coverage(kWidth, kWidth / 2);
  add_circle({towards(azimuth, elevation), std::cos(radius), std::sin(radius)}, 3, kSphere,
             coverage);
  return pixels_of(coverage);
}

TEST(Seam, ACircleGoesOnBeyondIt) {
  // A turn by columns of the image, of which the seam is one.
  for (const int columns : {90, 128, 140})
    expect_same(turned_show(circle_at(0, 0.3, 0.5), columns),
                circle_at(2 * pi * columns / kWidth, 0.3, 0.5));
}

TEST(Seam, ACircleAroundAPoleIsALineThroughAllColumns) {
  for (const double azimuth : {0.0, 3.1})
    for (const double elevation : {1.4, -1.4}) {
      const std::vector<double> pixels = circle_at(azimuth, elevation, 0.6);
      for (std::size_t column = 0; column < kWidth; ++column) {
        double sum = 0;
        for (std::size_t row = 0; row < kWidth / 2; ++row) sum += pixels[row * kWidth + column];
        // It is 3 pixels wide, and wider where it is slanted.
        EXPECT_GT(sum, 2.9) << column;
        EXPECT_LT(sum, 4.5) << column;
      }
    }
}

std::vector<double> text_at(double azimuth, double elevation) {
  Coverage coverage(kWidth, kWidth / 2);
  const M33d axes(1, 0, 0, 0, 1, 0, 0, 0, 1);
  const TextSurface surface(axes, azimuth, elevation, 0.3);
  add_text(lettering().letter("OHM", {}), surface, {0, 0}, kSphere, coverage);
  return pixels_of(coverage);
}

TEST(Seam, ATextGoesOnBeyondIt) {
  for (const int columns : {100, 128, 150})
    expect_same(turned_show(text_at(0, 0.2), columns), text_at(2 * pi * columns / kWidth, 0.2));
}

TEST(Seam, AnOutlineAroundAPoleIsFilledUpToIt) {
  Coverage coverage(kWidth, kWidth / 2);
  ImagePolygon outline;
  for (int k = 0; k < 64; ++k) {
    const auto pixel = pixel_of(kSphere, {towards(2 * pi * (k + 0.3) / 64, pi / 4)});
    outline.push_back(image_point(*pixel));
  }
  add_unwound(outline, kSphere, coverage);
  const std::vector<double> pixels = pixels_of(coverage);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    ASSERT_NEAR(std::abs(pixels[k]), k / kWidth < kWidth / 8 ? 1 : 0, 1e-3) << k;
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
