#include "pipeline/render/blobs/ellipse_blob.h"

#include <gtest/gtest.h>

#include <random>

#include "pipeline/render/blobs/blob_shape.h"
#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The mean of exp(-d P d / 2) over a pixel, by 4 points of Gauss-Legendre quadrature along each
// axis of each of 16 parts.
double mean_over_pixel(const BlobShape& s, double x, double y) {
  double sum = 0;
  for (int part = 0; part < 16; ++part)
    for (int k = 0; k < 16; ++k) {
      const double u = x + ((part % 4) - 1.5 + kGaussPoints[k % 4] / 2) / 4;
      const double v = y + ((part / 4) - 1.5 + kGaussPoints[k / 4] / 2) / 4;
      sum += kGaussWeights[k % 4] * kGaussWeights[k / 4] / 4 / 16 *
             std::exp(-(s.bare_xx * u * u + 2 * s.bare_xy * u * v + s.bare_yy * v * v) / 2);
    }
  return sum;
}

double worst_over_pixels(const BlobShape& s) {
  const FlattenedGaussian flattened(s.flattening);
  const double bare = 2 * pi / std::sqrt(s.bare_xx * s.bare_yy - s.bare_xy * s.bare_xy);
  const double blurred = 2 * pi / std::sqrt(s.xx * s.yy - s.xy * s.xy);
  double worst = 0;
  for (double x = 0; x < 5; x += 0.25)
    for (double y = -5; y < 5; y += 0.25) {
      const double w = std::exp(-(s.xx * x * x + 2 * s.xy * x * y + s.yy * y * y) / 2);
      worst =
          std::max(worst, std::abs(flattened(w) / (flattened.slope - flattened.dent / 2) / blurred -
                                   mean_over_pixel(s, x, y) / bare));
    }
  return worst * bare;
}

// What FlattenedGaussian claims in parts of the peak, at the zenith and at the rim.
TEST(EllipseBlobs, AreTheIntegralOverEachPixel) {
  const double unit = pi / 4096;
  for (const double azimuth : {0.0, 0.4, 0.785}) {
    const double x = 2047 * std::cos(azimuth), y = 2047 * std::sin(azimuth);
    EXPECT_LT(worst_over_pixels(blob_shape<true>(unit, x, y, 0.9 * unit)), 7e-4) << azimuth;
    EXPECT_LT(worst_over_pixels(blob_shape<true>(unit, x, y, 1.14 * unit)), 3e-4) << azimuth;
  }
  EXPECT_LT(worst_over_pixels(blob_shape<true>(unit, 0, 0, 0.9 * unit)), 5e-4);
  EXPECT_LT(worst_over_pixels(blob_shape<true>(unit, 0, 0, 1.14 * unit)), 2e-4);
  EXPECT_LT(worst_over_pixels(blob_shape<false>(unit, 0, 0, 1.8 * unit)), 5e-4);
}

struct Law {
  const char* name;
  Projection projection;
  double min_sigma_deg, most_theta;
};

const Law kLaws[] = {{"small dome", Domemaster{512}, 0.05, 84 * kDegree},
                     {"dome at the floor", Domemaster{1024}, 0.05, 88 * kDegree},
                     {"dome in degrees", Domemaster{4096}, 0.05, 89 * kDegree},
                     {"flat", Stereographic{1280, 720, 2.0}, 0.05, 30 * kDegree},
                     {"wide flat", Stereographic{1024, 1024, 5.0}, 0.05, 130 * kDegree}};

PointSpread widths_of(const Law& law) {
  PointSpreadLaw point_spread;
  point_spread.min_sigma = law.min_sigma_deg * kDegree, point_spread.max_sigma = 0.3 * kDegree;
  point_spread.reference_magnitude = -30;
  return {point_spread, law.projection, 1e3};
}

// The light is right to 1e-3, wherever the centre lies, for faint stars and for bright ones.
TEST(EllipseBlobs, BringTheirLightWhereverTheyLie) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  for (const Law& law : kLaws) {
    const PointSpread widths = widths_of(law);
    for (int k = 0; k < 150; ++k) {
      const double peak = std::pow(10, 5 * u(random) - 3);
      const StarImage image = image_at(law.projection, law.most_theta * u(random),
                                       2 * pi * u(random), flux_of_peak(widths, peak));
      EXPECT_NEAR(brought(image, law.projection, widths).flux / image.rgb[0], 1, 1e-3)
          << law.name << " " << image.x << " " << image.y << " " << peak;
    }
  }
}

// Stars that drift by 40 steps of a tenth of a pixel, across the zenith and near the rim, do not
// twinkle.
TEST(EllipseBlobs, KeepTheirLightWhileTheyDrift) {
  const Law& law = kLaws[1];
  const PointSpread widths = widths_of(law);
  for (const double start_x : {509.3, 40.2, 150.6})
    for (const double peak : {0.01, 1.0, 100.0})
      for (int k = 0; k < 40; ++k) {
        const auto flux = static_cast<float>(flux_of_peak(widths, peak));
        const StarImage image{static_cast<float>(start_x + 0.0717 * k),
                              static_cast<float>(508.9 + 0.0793 * k),
                              {flux, flux, flux}};
        EXPECT_NEAR(brought(image, law.projection, widths).flux / flux, 1, 1e-3) << image.x;
      }
}

// As docs/show-format.md says, the brightest pixel swings by a third at the smallest width, by a
// fifth at 4k with the default width, and by a twentieth at 8k.
TEST(EllipseBlobs, HaveABrightestPixelThatSwingsBySoMuch) {
  const auto swing = [](const Law& law) {
    const PointSpread widths = widths_of(law);
    const double middle = columns(law.projection) / 2;
    double low = 1e9, high = 0;
    for (int k = 0; k < 400; ++k) {
      const auto flux = static_cast<float>(flux_of_peak(widths, 0.1));
      const StarImage image{static_cast<float>(middle + 0.05 * (k % 20)),
                            static_cast<float>(middle + 0.05 * (k / 20)),
                            {flux, flux, flux}};
      const double peak = brought(image, law.projection, widths, 8).peak;
      low = std::min(low, peak), high = std::max(high, peak);
    }
    return high / low;
  };
  EXPECT_NEAR(swing(kLaws[1]), 1.32, 0.01);
  EXPECT_NEAR(swing(kLaws[2]), 1.20, 0.01);
  EXPECT_NEAR(swing({"8k", Domemaster{8192}, 0.05, 1}), 1.05, 0.01);
}

// Ellipses and caps are the same blobs up to where the former give way to the latter.
TEST(EllipseBlobs, AgreeWithCaps) {
  for (const Law& law : kLaws) {
    const Projection& p = law.projection;
    const double sigma = widths_of(law).least();
    double worst = 0;
    for (double theta = 0.01; theta < law.most_theta; theta += 0.1) {
      const StarImage image = image_at(p, theta, 2 * theta, sigma * sigma);
      EllipseBlob ellipse;
      int first_row = 0;
      BlobKind kind{};
      place_ellipses(p, &image, &sigma, 1, HUGE_VAL, &ellipse, &first_row, &kind);
      if (kind != BlobKind::kEllipse) continue;
      CapBlob cap{image.x, image.y, static_cast<float>(sigma), {}, 0};
      std::copy_n(image.rgb, 3, cap.rgb);
      ASSERT_TRUE(place_cap(p, cap));
      const int width = columns(p), first = cap.first_row, count = 8;
      for (int top = first; top <= cap.last_row; top += count) {
        const std::vector<ColumnRange> inside(count, {0, width - 1});
        std::vector<float> one(3 * width * count), other(one);
        draw_ellipses(&ellipse, 1, {one.data(), width, top, count, inside.data()});
        draw_cap(cap, p, {other.data(), width, top, count, inside.data()});
        for (std::size_t k = 0; k < one.size(); ++k)
          worst =
              std::max(worst, std::abs(static_cast<double>(one[k]) - other[k]) / ellipse.rgb[0]);
      }
    }
    EXPECT_LT(worst, 1.5e-3) << law.name;
  }
}

// The parts of halos that ellipses stand for, at the zenith and at the rim, faint and bright.  All
// that the cap covers is covered, band by band.
TEST(EllipseBlobs, StandForWideCaps) {
  int drawn_as_ellipses = 0, left = 0;
  for (const Law& law : kLaws)
    for (const double sigma_deg : {0.2, 0.48})
      for (const double peak : {0.004, 0.1, 5.0})
        for (const double part : {0.03, 0.5, 1.0}) {
          const Projection& p = law.projection;
          const double sigma = sigma_deg * kDegree;
          const StarImage image =
              image_at(p, part * law.most_theta, 7 * part, 2 * pi * peak * sigma * sigma);
          CapBlob cap{image.x, image.y, static_cast<float>(sigma), {}, 0};
          std::copy_n(image.rgb, 3, cap.rgb);
          ASSERT_TRUE(place_cap(p, cap));
          EllipseBlob ellipse;
          if (!place_wide_ellipse(p, cap, HUGE_VAL, ellipse)) {
            ++left;
            continue;
          }
          ++drawn_as_ellipses;
          const int width = columns(p), count = kBandRows;
          double worst = 0;
          for (int top = std::max(0, cap.first_row - count);
               top <= std::min(cap.last_row + count, rows(p) - count); top += count) {
            const std::vector<ColumnRange> inside(count, {0, width - 1});
            std::vector<float> one(static_cast<std::size_t>(3 * width * count)), other(one);
            draw_wide_ellipses(&ellipse, 1, {one.data(), width, top, count, inside.data()});
            draw_cap(cap, p, {other.data(), width, top, count, inside.data()});
            for (std::size_t k = 0; k < one.size(); ++k)
              worst = std::max(worst, std::abs(static_cast<double>(one[k]) - other[k]));
          }
          EXPECT_LT(worst, std::max(5e-4, 1.5e-3 * ellipse.rgb[0]))
              << law.name << " " << sigma_deg << " " << peak << " " << part;
        }
  EXPECT_GT(drawn_as_ellipses, 60);
  EXPECT_GT(left, 5);
}

// Where an image ends, a blob is cut: half of its light is left at an edge and a quarter in a
// corner.
TEST(EllipseBlobs, AtTheEdgesOfAnImageAreCutNotDimmed) {
  const Projection p = Stereographic{320, 200, 1.0};
  const PointSpread widths({0.001, 0, 40, 0.001}, p, 1e3);
  for (const double peak : {0.05, 3.0}) {
    const auto flux = static_cast<float>(flux_of_peak(widths, peak));
    const auto light = [&](float x, float y) {
      return brought({x, y, {flux, flux, flux}}, p, widths).flux / flux;
    };
    EXPECT_NEAR(light(-0.5f, 100.3f), 0.5, 2e-3);
    EXPECT_NEAR(light(319.5f, 100.8f), 0.5, 2e-3);
    EXPECT_NEAR(light(150.2f, -0.5f), 0.5, 2e-3);
    EXPECT_NEAR(light(319.5f, 199.5f), 0.25, 2e-3);
    EXPECT_EQ(light(-20, 100), 0);
  }
}

TEST(EllipseBlobs, InAnyOrderOfTasksGiveTheSameSums) {
  const Projection p = Domemaster{256};
  const PointSpread widths = widths_of({"", p, 0.05, 0});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(0, 256);
  std::vector<StarImage> images;
  for (int k = 0; k < 40000; ++k) {
    const auto flux = static_cast<float>(flux_of_peak(widths, 0.001 * (1 + k % 97)));
    images.push_back({u(random), u(random), {flux, flux / 2, flux / 3}});
  }
  const DrawnBlobs once = drawn(images, p, widths), again = drawn(images, p, widths);
  EXPECT_EQ(once.rgb, again.rgb);
  double sum = 0, expected = 0;
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column) sum += once.at(row, column, 1);
  for (const StarImage& i : images)
    if (std::hypot(i.x - 127.5, i.y - 127.5) < 128)
      expected += i.rgb[1] / pixel_solid_angle(p, {i.x + 1.0, i.y + 1.0});
  EXPECT_NEAR(sum / expected, 1, 0.01);  // the rim's staircase
}

}  // namespace
}  // namespace domefall
