// Frames whose pixels are not square, held against frames of square pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/stroke.h"
#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/rich_show.h"

namespace domefall {
namespace {

std::vector<Projection> anamorphic(int width, int height, double aspect) {
  return {Stereographic{width, height, 1.9, aspect}, Rectilinear{width, height, 1.6, aspect},
          Fisheye{width, height, 2.5, 0.25, aspect}};
}

// A sky with a hole, a disc, a body and stars, which are wider than any pixel.
LayeredFloatFrame frame_in(const Projection& projection) {
  Show show = rich_show(projection);
  show.titles.clear();
  show.point_spread.min_sigma = show.point_spread.max_sigma = 10 * kDegree;
  show.output.data.mattes = true;
  LayeredFloatFrame frame(kAllLayers, mattes_of(show));
  Renderer(show, 1).render(frame_state(show, 0), frame);
  return frame;
}

// The means of blocks of pixels with so many numbers each.
std::vector<float> means(const std::vector<float>& fine, int width, int numbers, int across,
                         int down) {
  std::vector<float> coarse(fine.size() / static_cast<std::size_t>(across * down));
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const int number = static_cast<int>(k) % numbers, pixel = static_cast<int>(k) / numbers;
    const int column = pixel % width / across, row = pixel / width / down;
    coarse[static_cast<std::size_t>((row * (width / across) + column) * numbers + number)] +=
        fine[k] / static_cast<float>(across * down);
  }
  return coarse;
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

void expect_same(const std::vector<float>& a, const std::vector<float>& b,
                 const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    most = std::max(most, double{std::abs(a[k] - b[k])} / std::max(1e-3f, std::abs(b[k])));
  EXPECT_LT(most, 1e-5) << what;
}

// A pixel twice as wide as high is the mean of two, in the picture, in layers and in mattes.
TEST(PixelAspectFrames, HavePairsOfSquarePixels) {
  for (const auto& [all, across, down] :
       {std::tuple{anamorphic(40, 72, 2), 2, 1}, std::tuple{anamorphic(72, 40, 0.5), 1, 2}})
    for (const Projection& p : all) {
      if (traits_of(p).is_dome) continue;  // whose rim is another, below
      LayeredFloatFrame wide = frame_in(p);
      LayeredFloatFrame square =
          frame_in(with_sides(with_pixel_aspect(p, 1), columns(p) * across, rows(p) * down));
      const std::string name(projection_name(p));
      const int width = square.picture.width;
      for (std::size_t k = 0; k < wide.lights().size(); ++k)
        expect_same(*wide.lights()[k], means(*square.lights()[k], width, 3, across, down), name);
      for (std::size_t k = 0; k < wide.alphas().size(); ++k)
        expect_same(*wide.alphas()[k], means(*square.alphas()[k], width, 1, across, down), name);
      EXPECT_GT(mean_of(wide.picture.pixels), 0.01) << name;
    }
}

// A frame's memory is used again, and what was drawn into it is gone.
TEST(PixelAspectFrames, AreTheSameInMemoryOfAnother) {
  const Show show = rich_show(Stereographic{40, 72, 1.9, 2});
  LayeredFloatFrame frame(kAllLayers);
  Renderer renderer(show, 1);
  renderer.render(frame_state(show, 0), frame);
  const std::vector<float> titles = frame.find(Layer::kTitles)->light.pixels;
  EXPECT_GT(mean_of(titles), 1e-3);
  renderer.render(frame_state(show, 0), frame);
  EXPECT_EQ(frame.find(Layer::kTitles)->light.pixels, titles);
}

// At the rim of a fisheye's circle, pixels whose middle lies beyond it are black.
TEST(PixelAspectFrames, OfAFisheyeEndAtItsCircle) {
  const Projection p = Fisheye{36, 72, 2.5, 0.25, 2}, square = Fisheye{72, 72, 2.5, 0.25};
  const auto wide = frame_in(p).picture.pixels,
             pairs = means(frame_in(square).picture.pixels, 72, 3, 2, 1);
  int shown = 0;
  for (int row = 0; row < 72; ++row) {
    const ColumnRange inside = inside_columns(p, row);
    for (int column = 0; column < 36; ++column) {
      const bool in = column >= inside.first && column <= inside.last;
      shown += in ? 1 : 0;
      for (int c = 0; c < 3; ++c) {
        const auto at = static_cast<std::size_t>(3 * (36 * row + column) + c);
        EXPECT_NEAR(wide[at], in ? pairs[at] : 0, 1e-5 * (1 + pairs[at])) << row << " " << column;
      }
    }
  }
  EXPECT_NEAR(shown, 3.14159 / 4 * 36 * 72, 40);
}

// The mean difference of a frame from the means of blocks of a finer one of square pixels, in parts
// of its mean.
double off_from_fine(const Projection& p, int across, int down) {
  const LayeredFloatFrame coarse = frame_in(p),
                          fine = frame_in(with_sides(with_pixel_aspect(p, 1), columns(p) * across,
                                                     rows(p) * down));
  const std::vector<float> exact = means(fine.picture.pixels, fine.picture.width, 3, across, down);
  double off = 0;
  for (std::size_t k = 0; k < exact.size(); ++k)
    off += std::abs(coarse.picture.pixels[k] - exact[k]);
  return off / static_cast<double>(exact.size()) / mean_of(exact);
}

// Pixels that are drawn as they are, since they are nearly square, are as right as square ones, of
// which a frame of 28 x 18 errs by 0.0609, 0.0599 and 0.1343 of its mean: one sample a pixel meets a
// disc's inner rings, and a circle ends within pixels.
TEST(PixelAspectFrames, OfNearlySquarePixelsAreAsRightAsThoseOfSquareOnes) {
  const double usual[] = {0.0609, 0.0599, 0.1343};
  const double* most = usual;
  for (const Projection& p : anamorphic(28, 24, 4. / 3)) {
    EXPECT_EQ(parts_nearly_square(p).across * parts_nearly_square(p).down, 1);
    EXPECT_LT(off_from_fine(p, 8, 6), 1.03 * *most++) << projection_name(p);
  }
}

// ---- stars ----

struct Moments {
  double flux = 0, xx = 0, yy = 0;  // variances in pixels
};
Moments moments(const DrawnBlobs& image) {
  Moments m;
  double x1 = 0, y1 = 0, all = 0;
  for (int row = 0; row < rows(image.projection); ++row)
    for (int column = 0; column < columns(image.projection); ++column) {
      const double v = image.at(row, column);
      all += v, x1 += v * column, y1 += v * row;
      m.xx += v * column * column, m.yy += v * row * row;
    }
  m.xx = m.xx / all - (x1 / all) * (x1 / all), m.yy = m.yy / all - (y1 / all) * (y1 / all);
  m.flux = flux_of(image);
  return m;
}

// Stars have all of their light, for ellipses, caps and bright ones, wherever they lie.
TEST(PixelAspectStars, BringTheirLightAndAreRoundOnTheScreen) {
  for (const double aspect : {0.75, 12. / 11, 4. / 3})
    for (const Projection& p : {Projection(Stereographic{320, 240, 1.6, aspect}),
                                Projection(Rectilinear{320, 240, 1.4, aspect}),
                                Projection(Fisheye{320, 240, 2.2, 0.5, aspect})})
      for (const double sigma_deg : {0.1, 1.5, 4.0}) {
        PointSpreadLaw law;
        law.min_sigma = law.max_sigma = sigma_deg * kDegree;
        law.reference_magnitude = -30;
        const PointSpread widths(law, p, 1e3);
        for (const double theta : {0.01, 0.2})
          for (const double peak : {0.1, 100.0}) {
            const StarImage star = image_at(p, theta, 0.7, flux_of_peak(widths, peak));
            const Moments m = moments(drawn({star}, p, widths));
            // Wide ellipses have the light of the blur by a pixel on top, of 1/12 pixel^2.
            const double pixels = widths.least() / largest_pixel_angle(p);
            const double blur = pixels > 1.5 ? 1 / (12 * pixels * pixels) : 0;
            EXPECT_NEAR(m.flux / star.rgb[0], 1, 2e-3 + blur)
                << projection_name(p) << " " << aspect;
            // The square of a pixel blurs by 1/12 along both sides.
            if (theta < 0.1) {
              EXPECT_NEAR((m.yy - 1. / 12) / (m.xx - 1. / 12) / (aspect * aspect), 1, 0.02)
                  << projection_name(p) << " " << aspect << " " << sigma_deg;
            }
          }
      }
}

// ---- overlays ----

struct Extent {
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL, ink = 0;
};
Extent extent(const Coverage& coverage) {
  Extent e;
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (parts[k] < 1e-6) continue;
      const double x = first + static_cast<double>(k);
      e.left = std::min(e.left, x), e.right = std::max(e.right, x + 1);
      e.top = std::min(e.top, double(row)), e.bottom = std::max(e.bottom, row + 1.0);
      e.ink += parts[k];
    }
  });
  return e;
}

// A line about the view's middle is as wide above it as beside it, and its ring is round.
TEST(PixelAspectOverlays, LinesAreOfEvenWidthOnTheScreen) {
  const Projection p = Stereographic{400, 600, 1.5, 2}, square = Stereographic{800, 600, 1.5};
  const ViewCircle circle{V3d(0, 0, 1), std::cos(0.4), std::sin(0.4)};
  Coverage wide(400, 600), usual(800, 600);
  add_curve(circle, 3, p, wide);
  add_curve(circle, 6, square, usual);
  const Extent a = extent(wide), b = extent(usual);
  EXPECT_NEAR(2 * a.ink, b.ink, 1e-3 * b.ink);
  EXPECT_NEAR(a.bottom - a.top, b.bottom - b.top, 1);
  EXPECT_NEAR(2 * (a.right - a.left), b.right - b.left, 2);
}

TEST(PixelAspectOverlays, TextIsNotStretchedOnTheScreen) {
  const LetteredText text = lettered("Frame 7", {});
  Coverage wide(400, 300), usual(400, 300);
  add_flat_text(text, {200, 150}, 20, {1, 0.5}, wide);
  add_flat_text(text, {200, 150}, 20, {1, 1}, usual);
  const Extent a = extent(wide), b = extent(usual);
  EXPECT_NEAR(a.ink, 2 * b.ink, 1e-3 * b.ink);
  EXPECT_NEAR(a.right - a.left, b.right - b.left, 1);
  EXPECT_NEAR(a.bottom - a.top, 2 * (b.bottom - b.top), 2);
}

}  // namespace
}  // namespace domefall
