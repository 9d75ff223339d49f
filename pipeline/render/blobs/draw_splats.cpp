#include "pipeline/render/blobs/draw_splats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

constexpr std::size_t kSplatBatch = 64;
constexpr int kRowFloats = 8, kRowBlocks = 8;
static_assert(kRowBlocks * kRowFloats == kSplatFloatsBeyond);
using Block = float __attribute__((vector_size(4 * kRowFloats)));
using SplatPixel = float __attribute__((vector_size(4 * kSplatChannels)));
using Pair = float __attribute__((vector_size(8 * kSplatChannels)));

// ---- the points at which a star is dropped ----

// A Point is one of the points at which a star is dropped.  Its offset along two axes is in units
// of the missing width, which is the square root of the variance that neither spline nor blur
// supplies.  Its share is the part of the light.
struct Point {
  float along, across, share;
};
// On a line the points are those of Gauss-Hermite quadrature, whose n points have the moments of a
// Gaussian up to order 2 n - 1.  In the plane they are a triangle, a cross, and a cross with its
// middle.  All have the variance 1 along both axes.
constexpr Point kOne[] = {{0, 0, 1}};
constexpr Point kTwo[] = {{-1, 0, 0.5f}, {1, 0, 0.5f}};
constexpr Point kThree[] = {
    {-1.7320508f, 0, 1.0f / 6}, {0, 0, 2.0f / 3}, {1.7320508f, 0, 1.0f / 6}};
constexpr Point kFour[] = {{-2.3344142f, 0, 0.045875855f},
                           {-0.74196378f, 0, 0.454124145f},
                           {0.74196378f, 0, 0.454124145f},
                           {2.3344142f, 0, 0.045875855f}};
constexpr Point kFive[] = {{-2.8569700f, 0, 0.011257411f},
                           {-1.3556262f, 0, 0.222075922f},
                           {0, 0, 0.533333333f},
                           {1.3556262f, 0, 0.222075922f},
                           {2.8569700f, 0, 0.011257411f}};
constexpr Point kTriangle[] = {{1.4142136f, 0, 1.0f / 3},
                               {-0.70710678f, 1.2247449f, 1.0f / 3},
                               {-0.70710678f, -1.2247449f, 1.0f / 3}};
constexpr Point kCross[] = {{1.4142136f, 0, 0.25f},
                            {-1.4142136f, 0, 0.25f},
                            {0, 1.4142136f, 0.25f},
                            {0, -1.4142136f, 0.25f}};
constexpr Point kCrossWithMiddle[] = {
    {0, 0, 0.5f}, {2, 0, 0.125f}, {-2, 0, 0.125f}, {0, 2, 0.125f}, {0, -2, 0.125f}};

// A Rule is a set of points.  `missing` is the missing variance over the blob's, which a rule has
// to supply.  The thresholds are our choice.  Smaller ones would drop a star at more points, each
// of which costs a splat, and larger ones would err more.  The errors beside them are the largest
// differences between the Gaussian and the sum that stands for it, in parts of the peak.  They were
// computed at the end of each range, where they are largest, without the pixels and the spline.
struct Rule {
  const Point* points;
  int count;
};
// On a dome variance is missing along one axis only.  At the rim 0.595 of it is missing, where four
// points err by 0.045.  Only batches with a star beyond the rim take five points, which err by
// 0.030 at 0.63.
constexpr Rule line_rule(float missing) {
  if (missing < 0.02f) return {kOne, 1};    // errs by up to 0.010
  if (missing < 0.2f) return {kTwo, 2};     // errs by up to 0.013
  if (missing < 0.43f) return {kThree, 3};  // errs by up to 0.025
  if (missing < 0.63f) return {kFour, 4};   // errs by up to 0.064
  return {kFive, 5};
}
// On a flat image variance is missing along both axes.  SplatBuckets takes no splat where more than
// 0.31 of it is missing, and there the five points err by 0.020.
constexpr Rule plane_rule(float missing) {
  if (missing < 0.02f) return {kOne, 1};       // errs by up to 0.020
  if (missing < 0.09f) return {kTriangle, 3};  // errs by up to 0.005
  if (missing < 0.15f) return {kCross, 4};     // errs by up to 0.014
  return {kCrossWithMiddle, 5};
}

// ---- dropping ----

// The splats of a batch are stored column by column.
using SplatColumn = std::array<float, kSplatBatch>;
struct Splats {
  alignas(64) SplatColumn x, y;
  // These are the missing widths as vectors, in pixels.
  alignas(64) SplatColumn along_x, along_y, across_x, across_y;
  alignas(64) SplatColumn density;  // 1 / solid angle of the pixel, 1 / sr
};
// These are the cubic B-splines of a batch, each about one point of its star: their weights along
// x, their weights along y times the point's light, and the first of their four columns and rows.
struct Splines {
  alignas(64) SplatColumn x0, x1, x2, x3, y0, y1, y2, y3;
  alignas(64) std::array<int, kSplatBatch> column, row;
};

// The series is that of u = (1 - sinc theta)/theta^2 in theta^2, as in blob_shape.h.  The next term
// is below 2e-9 at theta = 1.9.
constexpr std::array<float, 6> kSincSeries{1.0f / 6,       -1.0f / 120,     1.0f / 5040,
                                           -1.0f / 362880, 1.0f / 39916800, -1.0f / 6227020800.0f};

// Sets the missing widths and the densities, and returns the largest missing part of a blob's
// variance.  blob_shape.h derives the variances.  With v the variance in the middle, they are v
// along the meridian and v/sinc^2 along the tangent of a dome, and v (1 + t)^2 in all directions of
// a flat image.  Positive floats have the same order as their bits taken for integers, whose
// maximum the compiler vectorises.
template <bool kDome>
[[gnu::always_inline]] inline float find_missing(const SplatFrame& frame, Splats& d) {
  const SplatFrame f = frame;
  std::int32_t most = 0;
  for (std::size_t k = 0; k < kSplatBatch; ++k) {
    const float cx = d.x[k] - f.middle_x, cy = d.y[k] - f.middle_y;
    const float t = f.unit2 * (cx * cx + cy * cy);
    if constexpr (kDome) {
      float u = kSincSeries[5];
      for (std::size_t n = 5; n-- > 0;) u = u * t + kSincSeries[n];
      const float sinc = 1 - t * u, inverse = 1 / sinc, missing = 1 - sinc * sinc;
      const auto bits = std::bit_cast<std::int32_t>(missing);
      most = bits > most ? bits : most;
      // The missing variance along the tangent (-cy, cx) is v (1/sinc^2 - 1), where
      // 1 - sinc^2 = t u (1 + sinc) and t = unit2 |c|^2.
      const float width = std::sqrt(f.variance * f.unit2 * u * (1 + sinc)) * inverse;
      d.along_x[k] = -cy * width;
      d.along_y[k] = cx * width;
      d.across_x[k] = d.across_y[k] = 0;
      d.density[k] = f.density * inverse;
    } else {
      // The missing variance is v ((1 + t)^2 - 1) = v t (2 + t).
      const float grown = 1 + t, width = std::sqrt(f.variance * t * (1 + grown));
      const float missing = 1 - 1 / (grown * grown);
      const auto bits = std::bit_cast<std::int32_t>(missing);
      most = bits > most ? bits : most;
      d.along_x[k] = width;
      d.along_y[k] = 0;
      d.across_x[k] = 0;
      d.across_y[k] = width;
      d.density[k] = f.density * (grown * grown);
    }
  }
  return std::bit_cast<float>(most);
}

constexpr int kPositive = 256;  // makes numbers positive, so that truncation rounds down

// Finds the splines about one point of each star.  At a fraction f beyond a pixel the four weights
// of the cubic B-spline are (1 - f)^3/6, 2/3 + f^2 (3 f - 6)/6, the same as the second with 1 - f
// for f, and f^3/6.
[[gnu::always_inline]] inline void find_splines(const Point& point, const Splats& d, Splines& at) {
  const Point p = point;
  for (std::size_t k = 0; k < kSplatBatch; ++k) {
    const float x = d.x[k] + (p.along * d.along_x[k] + p.across * d.across_x[k]);
    const float y = d.y[k] + (p.along * d.along_y[k] + p.across * d.across_y[k]);
    const int column = static_cast<int>(x + kPositive) - kPositive;
    const int row = static_cast<int>(y + kPositive) - kPositive;
    const float g = y - static_cast<float>(row), h = 1 - g;
    const float sixth = p.share * d.density[k] * (1.0f / 6), whole = 4 * sixth;
    const float f = x - static_cast<float>(column), e = 1 - f;
    at.x0[k] = (1.0f / 6) * (e * e * e);
    at.x3[k] = (1.0f / 6) * (f * f * f);
    at.x1[k] = (2.0f / 3) + (1.0f / 6) * (f * f * (3 * f - 6));
    at.x2[k] = (2.0f / 3) + (1.0f / 6) * (e * e * (3 * e - 6));
    at.column[k] = column - 1;
    at.row[k] = row - 1;
    at.y0[k] = sixth * (h * h * h);
    at.y3[k] = sixth * (g * g * g);
    at.y1[k] = whole + sixth * (g * g * (3 * g - 6));
    at.y2[k] = whole + sixth * (h * h * (3 * h - 6));
  }
}

[[gnu::always_inline]] inline void add_to(float* out, const Pair& light) {
  Pair sum;
  std::memcpy(&sum, out, sizeof sum);
  sum += light;
  std::memcpy(out, &sum, sizeof sum);
}

// Adds the splines to four rows each, with two pixels in each register.
[[gnu::always_inline]] inline void add_splines(const SplatPixel* light, std::size_t count,
                                               const Splines& at, const SplatRows& rows) {
  for (std::size_t k = 0; k < count; ++k) {
    const SplatPixel x0 = light[k] * at.x0[k], x1 = light[k] * at.x1[k], x2 = light[k] * at.x2[k],
                     x3 = light[k] * at.x3[k];
    const Pair left = __builtin_shufflevector(x0, x1, 0, 1, 2, 3, 4, 5, 6, 7);
    const Pair right = __builtin_shufflevector(x2, x3, 0, 1, 2, 3, 4, 5, 6, 7);
    const std::ptrdiff_t column = kSplatChannels * std::ptrdiff_t{at.column[k]};
    float* const* row = rows.row + (at.row[k] - rows.first);
    const float y[4] = {at.y0[k], at.y1[k], at.y2[k], at.y3[k]};
    for (int j = 0; j < 4; ++j) {
      float* out = row[j] + column;
      add_to(out, left * y[j]);
      add_to(out + 2 * kSplatChannels, right * y[j]);
    }
  }
}

// Drops a batch.  If it has fewer than kSplatBatch stars, the last star fills the rest, but only
// `count` stars are added.
template <bool kDome>
[[gnu::always_inline]] inline void drop_batch(const SplatFrame& frame, const StarImage* images,
                                              std::size_t count, const SplatRows& rows) {
  Splats splats;
  Splines splines;
  alignas(64) SplatPixel light[kSplatBatch];
  for (std::size_t k = 0; k < kSplatBatch; ++k) {
    const StarImage& image = images[k < count ? k : count - 1];
    splats.x[k] = image.x;
    splats.y[k] = image.y;
    light[k] = SplatPixel{image.rgb[0], image.rgb[1], image.rgb[2], 0};
  }
  const float missing = find_missing<kDome>(frame, splats);
  const Rule rule = kDome ? line_rule(missing) : plane_rule(missing);
  for (int p = 0; p < rule.count; ++p) {
    find_splines(rule.points[p], splats, splines);
    add_splines(light, count, splines, rows);
  }
}

[[gnu::always_inline]] inline void drop_on_dome(const SplatFrame& frame, const StarImage* images,
                                                std::size_t count, const SplatRows& rows) {
  drop_batch<true>(frame, images, count, rows);
}
[[gnu::always_inline]] inline void drop_on_flat(const SplatFrame& frame, const StarImage* images,
                                                std::size_t count, const SplatRows& rows) {
  drop_batch<false>(frame, images, count, rows);
}
Dispatched<drop_on_dome> to_dome;
Dispatched<drop_on_flat> to_flat;

// ---- blurring ----

// Sets kRowBlocks blocks of `out` from float k on to sums over the rows.  The n-th row from the
// middle one is read n * step floats farther on.
[[gnu::always_inline]] inline void blur_blocks(const SplatBlur& blur, const float* const* rows,
                                               std::ptrdiff_t step, std::ptrdiff_t k, float* out) {
  Block sum[kRowBlocks];
  for (int b = 0; b < kRowBlocks; ++b) {
    std::memcpy(&sum[b], rows[blur.taps] + k + b * kRowFloats, sizeof sum[b]);
    sum[b] *= blur.tap[0];
  }
  for (int n = 1; n <= blur.taps; ++n) {
    const float* before = rows[blur.taps - n] + k - n * step;
    const float* after = rows[blur.taps + n] + k + n * step;
    for (int b = 0; b < kRowBlocks; ++b) {
      Block p, q;
      std::memcpy(&p, before + b * kRowFloats, sizeof p);
      std::memcpy(&q, after + b * kRowFloats, sizeof q);
      sum[b] += blur.tap[n] * (p + q);
    }
  }
  for (int b = 0; b < kRowBlocks; ++b)
    std::memcpy(out + k + b * kRowFloats, &sum[b], sizeof sum[b]);
}

// The loop runs on beyond `count` to a whole number of blocks.
[[gnu::always_inline]] inline void blur_down_loop(const SplatBlur& blur, const float* const* rows,
                                                  int lines, int count, float* out,
                                                  std::ptrdiff_t stride) {
  for (int k = 0; k < count; k += kRowBlocks * kRowFloats)
    for (int line = 0; line < lines; ++line)
      blur_blocks(blur, rows + line, 0, k, out + line * stride);
}
Dispatched<blur_down_loop> down;

// The blur along a row reads the same row for every tap, each time a pixel farther on.
[[gnu::always_inline]] inline void blur_along_loop(const SplatBlur& blur, const float* row,
                                                   int count, float* between,
                                                   float* __restrict out) {
  const float* rows[2 * kMostSplatTaps + 1];
  for (int n = 0; n <= 2 * blur.taps; ++n) rows[n] = row;
  for (int k = 0; k < kSplatChannels * count; k += kRowBlocks * kRowFloats)
    blur_blocks(blur, rows, kSplatChannels, k, between);
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 3; ++c) out[3 * k + c] += between[kSplatChannels * k + c];
}
Dispatched<blur_along_loop> along;

}  // namespace

void drop_splats(bool dome, const SplatFrame& frame, const StarImage* images, std::size_t count,
                 const SplatRows& rows) {
  for (std::size_t k = 0; k < count; k += kSplatBatch) {
    const std::size_t n = std::min(kSplatBatch, count - k);
    if (dome)
      to_dome(frame, images + k, n, rows);
    else
      to_flat(frame, images + k, n, rows);
  }
}

void blur_down(const SplatBlur& blur, const float* const* rows, int lines, int count, float* out,
               std::ptrdiff_t stride) {
  down(blur, rows, lines, count, out, stride);
}

void blur_along(const SplatBlur& blur, const float* row, int count, float* between, float* rgb) {
  along(blur, row, count, between, rgb);
}

}  // namespace domefall
