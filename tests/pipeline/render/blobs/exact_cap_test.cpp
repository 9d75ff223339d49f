#include "pipeline/render/blobs/exact_cap.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/scenes.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Projections that have no loops of their own for blobs.
const std::vector<Projection>& other_projections() {
  static const std::vector<Projection> all{Rectilinear{160, 100, 110 * kDegree},
                                           Fisheye{128, 128, 220 * kDegree, 0},
                                           Fisheye{128, 95, 2 * pi, 1}, Equirectangular{180}};
  return all;
}

PointSpread cap_widths(const Projection& p, double sigma) {
  PointSpreadLaw law;
  law.min_sigma = law.max_sigma = sigma;
  if (!has_zenith(p)) law.min_sigma = law.max_sigma = sigma * pi / *field_of_view(p);
  law.reference_magnitude = -30;
  return {law, p, 1e3};
}

StarImage image_on(const PixelPosition& at, double flux) {
  const auto light = static_cast<float>(flux);
  return {static_cast<float>(at.i - 1), static_cast<float>(at.j - 1), {light, light, light}};
}

// The mean over a pixel's solid angle of a Gaussian that is round in angle, of that peak and with
// the cut, by 4 points of Gauss-Legendre quadrature along each axis.
double mean_of_cap(const Projection& p, const CameraDirection& star, double sigma, double peak,
                   int column, int row) {
  const double cut = cut_of(peak);
  double sum = 0, whole = 0;
  for (int k = 0; k < 16; ++k) {
    const PixelPosition at{column + 1 + kGaussPoints[k % 4] / 2, row + 1 + kGaussPoints[k / 4] / 2};
    const double c2 = (direction_at(p, at).v - star.v).length2();
    const double part = kGaussWeights[k % 4] * kGaussWeights[k / 4] * pixel_solid_angle(p, at);
    sum += part * std::max(0.0, std::exp(-c2 / (2 * sigma * sigma)) - cut);
    whole += part;
  }
  return peak * sum / whole;
}

// Whatever draws a blob, and wherever: at seams, poles and corners, behind a fisheye, far and near.
TEST(BlobsInEveryProjection, AreRoundInAngle) {
  std::mt19937 random(1);
  for (const Projection& p : other_projections()) {
    std::uniform_real_distribution<double> u(-2, columns(p) + 2), v(-2, rows(p) + 2);
    for (int k = 0; k < tries(12, 6); ++k) {
      PixelPosition at{u(random), v(random)};
      if (k % 5 == 1) at.i = k % 2 == 0 ? 0.6 : columns(p) + 0.3;
      if (k % 5 == 2) at.j = k % 2 == 0 ? 0.7 : rows(p) + 0.2;
      at = pixel_of(p, direction_at(p, at)).value();  // beyond a seam it is on the other side
      const double pixel = largest_pixel_angle(p), sigma = pixel * (k % 3 == 0   ? 0.95
                                                                    : k % 3 == 1 ? 2.5
                                                                                 : 9);
      const double peak = k % 4 == 0 ? 0.02 : 5;
      const PointSpread widths = cap_widths(p, sigma);
      const StarImage image = image_on(at, flux_of_peak(widths, peak));
      const CameraDirection star = direction_at(p, {image.x + 1.0, image.y + 1.0});
      const DrawnBlobs drawn_image = drawn({image}, p, widths);
      double worst = 0;
      for (int row = 0; row < rows(p); ++row) {
        const ColumnRange in = inside_columns(p, row);
        for (int column = in.first; column <= in.last; ++column) {
          const double value = drawn_image.at(row, column);
          const V3d n = direction_at(p, {column + 1.0, row + 1.0}).v;
          const double chord = (n - star.v).length();
          // The rim of the whole sphere's circle is one point, beyond which squares wind on.
          if (std::holds_alternative<Fisheye>(p) && n.z < std::cos(pi - pixel)) continue;
          // Of a wide blob a part of the pixels is enough.
          if (sigma > 5 * pixel && (row + column) % 5 != 0) continue;
          if (value == 0 && chord > 7 * sigma + pixel) continue;
          const double expected = mean_of_cap(p, star, sigma, peak, column, row);
          worst = std::max(worst, std::abs(value - expected));
        }
      }
      // That of ellipses: 3.6e-3 of the peak for the change of scale, and 7e-4 for the pixels.
      EXPECT_LT(worst, std::max(4.3e-3 * peak, 8e-4))
          << projection_name(p) << " " << at.i << " " << at.j << " sigma " << sigma / pixel;
    }
  }
}

TEST(BlobsInEveryProjection, BringTheirLightWhereverTheyLie) {
  std::mt19937 random(2);
  for (const Projection& p :
       {Projection(Equirectangular{400}), Projection(Fisheye{400, 400, 2 * pi, 0})}) {
    const PointSpread widths = cap_widths(p, 1.2 * largest_pixel_angle(p));
    for (int k = 0; k < tries(80, 10); ++k) {
      V3d n = random_direction(random);
      if (k % 8 == 0) n = V3d(1e-3 * n.x, 1e-3 * n.y, k % 16 == 0 ? 1 : -1).normalized();
      if (k % 8 == 1) n = V3d(1e-3 * n.x, -1, n.z).normalized();
      // The circle's rim is a staircase.
      if (std::holds_alternative<Fisheye>(p) && n.z < -0.95) continue;
      const auto at = pixel_of(p, {n});
      const StarImage image = image_on(*at, flux_of_peak(widths, k % 2 == 0 ? 0.05 : 3));
      const Brought light = brought(image, p, widths, rows(p));
      EXPECT_NEAR(light.flux / image.rgb[0], 1, 2e-3) << projection_name(p) << " " << n;
    }
  }
}

// A point of a pixel there has no distance from the middle.
TEST(BlobsInEveryProjection, AreFiniteInTheVeryMiddleOfAFisheye) {
  const Projection p = Fisheye{65, 65, 0.1, 0};
  const PointSpread widths = cap_widths(p, 17 * largest_pixel_angle(p));
  const DrawnBlobs image = drawn({image_on({33, 33}, flux_of_peak(widths, 1))}, p, widths);
  EXPECT_NEAR(image.at(32, 32), 1, 3e-3);
  EXPECT_NEAR(image.at(32, 33), image.at(32, 32), 3e-3);
}

// Against what draws caps on a dome and a stereographic image.
TEST(ExactCaps, AreTheCapsOfADomeAndAFlatImage) {
  std::mt19937 random(3);
  for (const Projection& p :
       {Projection(Domemaster{300}), Projection(Stereographic{300, 200, 2})}) {
    std::uniform_real_distribution<double> u(0, 300), v(0, rows(p));
    const int width = columns(p);
    std::vector<ColumnRange> in;
    for (int row = 0; row < rows(p); ++row) in.push_back(inside_columns(p, row));
    for (int k = 0; k < tries(20, 4); ++k) {
      CapBlob cap{};
      cap.x = static_cast<float>(u(random)), cap.y = static_cast<float>(v(random));
      cap.sigma = static_cast<float>((k % 2 == 0 ? 1.5 : 8) * largest_pixel_angle(p));
      const double light = 10 * 2 * pi * cap.sigma * cap.sigma;
      for (int c = 0; c < 3; ++c) cap.rgb[c] = static_cast<float>(light * (1 + c));
      cap.paling = k % 3 == 0 ? 0.1f : 0.0f;
      CapBlob exact = cap;
      if (!place_cap(p, cap)) continue;
      ASSERT_TRUE(place_exact_cap(p, exact)) << cap.x << " " << cap.y;
      std::vector<float> expected(3 * static_cast<std::size_t>(width) * in.size()), found(expected);
      for (int first = 0; first < rows(p); first += kBandRows) {
        const int count = std::min(kBandRows, rows(p) - first);
        const std::ptrdiff_t row = 3 * std::ptrdiff_t{first} * width;
        draw_cap(cap, p,
                 {&expected[static_cast<std::size_t>(row)], width, first, count,
                  &in[static_cast<std::size_t>(first)]});
        draw_exact_cap(exact, p,
                       {&found[static_cast<std::size_t>(row)], width, first, count,
                        &in[static_cast<std::size_t>(first)]});
      }
      for (std::size_t m = 0; m < expected.size(); ++m)
        ASSERT_NEAR(found[m], expected[m], 30 * 1.5e-3) << k << " " << m;
    }
  }
}

}  // namespace
}  // namespace domefall
