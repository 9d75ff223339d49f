#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/scene/point_spread.h"

namespace domefall {
namespace {

// A blob is drawn in strips of kPixels columns, each of which is six vectors of eight floats.
// Vectors of sixteen floats are no quicker with AVX-512, and without AVX-512 GCC splits them into
// single floats.
constexpr int kPixels = 16, kFloats = 3 * kPixels;
using LaneBits = std::int32_t __attribute__((vector_size(4 * kLanes)));
constexpr std::size_t kBatch = 32;
// Added to columns and rows, this makes them positive, so that truncation rounds down.
constexpr int kEllipseMargin = 2 * kMostWideEllipsePixels;
static_assert(kBandRows <= kPixels);

// ---- what drawing needs of each blob ----

// Returns -ln x for x > 0, or up to 0.06 more.  Read as an integer, the bits of a float are about
// 2^23 (127 + log2 x): for a mantissa 1 <= m < 2 they hold m - 1, which is below log2 m by at most
// 0.086 = 0.06/ln 2.
[[gnu::always_inline]] inline float about_minus_log(float x) {
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x)) * 0x1p-23f;
  return (127.0f - bits) * 0.69314718f;
}

// A batch of blobs is stored column by column, so that a loop computes all blobs at once.  Pixels
// count from 0.
//
// A pixel's value is that of FlattenedGaussian minus the value at the cut.  With u = part W and
// part = dent/slope it is W (slope - dent W) = gain (u - u^2), where gain = slope/part.
struct PreparedEllipses {
  alignas(64) std::array<float, kBatch> dx, dy;      // from the centre to the first pixel drawn
  alignas(64) std::array<float, kBatch> xx, xy, yy;  // of -q: -P_xx/2, -P_xy and -P_yy/2
  alignas(64) std::array<float, kBatch> part, gain;
  alignas(64) std::array<float, kBatch> end;  // u - u^2 at the cut
  alignas(64) std::array<int, kBatch> column, columns;
  alignas(64) std::array<int, kBatch> first, last;  // rows, within the canvas
};

// Narrows the columns of a blob down to those that the ellipse covers on the canvas.  `spread`,
// half_x and half_y are those of prepare().
//
// The ellipse d P d = 2 q reaches farthest to the right at y = -half_x P_xy/P_yy, where d P d has
// no slope along y.  At another y it reaches to the larger root x of the quadratic equation,
//     x = (-P_xy y + sqrt(2 q P_xx - det P y^2))/P_xx.
// This decreases on both sides of the farthest point, so the row of the canvas nearest to that
// point decides.  To the left all signs are changed.
[[gnu::always_inline]] inline void narrow_columns(const EllipseBlob& b, float spread, float half_x,
                                                  float half_y, std::size_t k,
                                                  PreparedEllipses& prepared) {
  const auto last = static_cast<float>(prepared.last[k]) - b.y;
  const float top = prepared.dy[k] > -half_y ? prepared.dy[k] : -half_y;
  const float bottom = last < half_y ? last : half_y;
  const float determinant = b.xx * b.yy - b.xy * b.xy, farthest = half_x * b.xy / b.yy;
  const float below = -farthest > top ? -farthest : top, right_y = below < bottom ? below : bottom;
  const float above = farthest > top ? farthest : top, left_y = above < bottom ? above : bottom;
  const float right_square = determinant * (spread * b.xx - right_y * right_y);
  const float left_square = determinant * (spread * b.xx - left_y * left_y);
  const float right_root = std::sqrt(right_square > 0 ? right_square : 0.0f);
  const float left_root = std::sqrt(left_square > 0 ? left_square : 0.0f);
  const float right_x = b.x + (right_root - b.xy * right_y) / b.xx;
  const float left_x = b.x - (left_root + b.xy * left_y) / b.xx;
  const int left = static_cast<int>(left_x + kEllipseMargin) - kEllipseMargin;
  const int right = static_cast<int>(right_x + kEllipseMargin) - (kEllipseMargin - 1);
  const int begin = prepared.column[k], end = begin + prepared.columns[k] - 1;
  prepared.column[k] = left > begin ? left : begin;
  prepared.columns[k] = (right < end ? right : end) - prepared.column[k] + 1;
  prepared.dx[k] = static_cast<float>(prepared.column[k]) - b.x;
}

// Prepares a batch.  The ellipse q = -ln(cut) has the half width sqrt(2 q C_xx) along x, where C_xx
// = P_yy/det P belongs to the covariance, the inverse of P.
template <bool kWide>
[[gnu::always_inline]] inline void prepare(const EllipseBlob* blobs, std::size_t count,
                                           const Canvas& canvas, PreparedEllipses& prepared) {
  const int first_row = canvas.first_row, end_row = canvas.first_row + canvas.rows - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const EllipseBlob& b = blobs[k];
    const float warm = b.rgb[0] > b.rgb[1] ? b.rgb[0] : b.rgb[1];
    const float peak = warm > b.rgb[2] ? warm : b.rgb[2];
    // The cut is that of cut_of() for this peak.
    const float low = static_cast<float>(kUnseen) / peak;
    const auto highest = static_cast<float>(kHighestCut), lowest = static_cast<float>(kLowestCut);
    const float high = low < highest ? low : highest, cut = high > lowest ? high : lowest;
    const float spread = 2 * about_minus_log(cut) / (b.xx * b.yy - b.xy * b.xy);
    const float half_x = std::sqrt(spread * b.yy), half_y = std::sqrt(spread * b.xx);
    const int left = static_cast<int>(b.x - half_x + kEllipseMargin) - (kEllipseMargin - 1);
    const int right = static_cast<int>(b.x + half_x + kEllipseMargin) - kEllipseMargin;
    const int top = static_cast<int>(b.y - half_y + kEllipseMargin) - (kEllipseMargin - 1);
    const int bottom = static_cast<int>(b.y + half_y + kEllipseMargin) - kEllipseMargin;
    const int first = top > first_row ? top : first_row;
    const float flattening = (b.xx * b.xx + b.yy * b.yy) * static_cast<float>(1.0 / 5760);
    const float slope = 1 + 7.5f * flattening, dent = 13.5f * flattening, part = dent / slope;
    prepared.column[k] = left;
    prepared.columns[k] = right - left + 1;
    prepared.first[k] = first;
    prepared.last[k] = bottom < end_row ? bottom : end_row;
    prepared.dx[k] = static_cast<float>(left) - b.x;
    prepared.dy[k] = static_cast<float>(first) - b.y;
    prepared.xx[k] = -0.5f * b.xx;
    prepared.xy[k] = -b.xy;
    prepared.yy[k] = -0.5f * b.yy;
    prepared.part[k] = part;
    prepared.gain[k] = slope / part;
    prepared.end[k] = part * cut * (1 - part * cut);
    if constexpr (kWide) narrow_columns(b, spread, half_x, half_y, k, prepared);
  }
}

// ---- strips ----

// A Strip is the part of a blob from the blob's column `first` on.
struct Strip {
  int blob, first;
};

// Lists the strips that begin with column `first` of their blobs and touch the canvas.  Returns
// their number.
[[gnu::always_inline]] inline int list_strips(const PreparedEllipses& prepared, std::size_t count,
                                              int first, Strip* strips) {
  int listed = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // Each round writes a strip, and the next round overwrites it if it does not count.  This needs
    // no branch.
    strips[listed] = {static_cast<int>(k), first};
    listed += prepared.first[k] <= prepared.last[k] && prepared.columns[k] > first ? 1 : 0;
  }
  return listed;
}

// The weights of a strip are products of these exponentials.  With (x, y) the offset of a pixel
// from the centre, and y0 that of the first row,
//     W = exp(-P_xx x^2/2 - P_xy x y0) exp(-P_xy x)^(y - y0) exp(-P_yy y^2/2).
struct StripExponentials {
  alignas(64) float weight[kPixels];  // of the first row, without the row's factor
  alignas(64) float step[kPixels];    // from row to row
  alignas(64) float rows[kPixels];    // the factor of each row, times `part`
};

[[gnu::always_inline]] inline void find_exponentials(const PreparedEllipses& prepared,
                                                     const Strip* strips, int count,
                                                     StripExponentials* exponentials) {
  for (int n = 0; n < count; ++n) {
    const auto k = static_cast<std::size_t>(strips[n].blob);
    const float x0 = prepared.dx[k] + static_cast<float>(strips[n].first), y0 = prepared.dy[k],
                xx = prepared.xx[k], xy = prepared.xy[k], yy = prepared.yy[k], along = xy * y0,
                scale = prepared.part[k];
    StripExponentials& strip = exponentials[n];
    for (int m = 0; m < kPixels; ++m) {
      const float dx = x0 + static_cast<float>(m), dy = y0 + static_cast<float>(m);
      strip.weight[m] = exponential_of_float((xx * dx + along) * dx);
      strip.step[m] = exponential_of_float(xy * dx);
      strip.rows[m] = scale * exponential_of_float(yy * dy * dy);
    }
  }
}

// Replaces negative values by 0.  It compares the bits: read as an integer, the bits of a negative
// float are negative.
[[gnu::always_inline]] inline void keep_positive(Lanes& v) {
  LaneBits bits;
  std::memcpy(&bits, &v, sizeof v);
  bits = bits > 0 ? bits : LaneBits{};
  std::memcpy(&v, &bits, sizeof v);
}

// Adds the rows of a strip to `out`, which begins with the strip's first pixel.  Of each row kCount
// vectors are drawn.
template <int kCount>
[[gnu::always_inline]] inline void add_rows(const EllipseBlob& blob,
                                            const PreparedEllipses& prepared, std::size_t k,
                                            const StripExponentials& strip, float* __restrict out,
                                            std::ptrdiff_t stride) {
  Lanes weight[6], step[6];
  repeat_for_channels<kCount>(strip.weight, weight);
  repeat_for_channels<kCount>(strip.step, step);
  const float gain = prepared.gain[k], r = gain * blob.rgb[0], g = gain * blob.rgb[1],
              b = gain * blob.rgb[2], end = prepared.end[k];
  // Three vectors hold the colours of eight pixels, so the channels begin anew with every third
  // vector.
  const Lanes scale[3] = {
      {r, g, b, r, g, b, r, g}, {b, r, g, b, r, g, b, r}, {g, b, r, g, b, r, g, b}};
  for (int j = 0; j <= prepared.last[k] - prepared.first[k]; ++j, out += stride) {
    const float row = strip.rows[j];
    for (int m = 0; m < kCount; ++m) {
      const Lanes u = weight[m] * row;
      Lanes v = (u - u * u) - end;
      keep_positive(v);
      Lanes sum;
      std::memcpy(&sum, out + m * kLanes, sizeof sum);
      sum += scale[m % 3] * v;
      std::memcpy(out + m * kLanes, &sum, sizeof sum);
      weight[m] *= step[m];
    }
  }
}

// Adds a strip to `out`, which begins with its first pixel.  Narrow blobs need fewer vectors.
[[gnu::always_inline]] inline void add_strip(const EllipseBlob& blob,
                                             const PreparedEllipses& prepared, const Strip& at,
                                             const StripExponentials& strip, float* out,
                                             std::ptrdiff_t stride) {
  const auto k = static_cast<std::size_t>(at.blob);
  const int floats = 3 * (prepared.columns[k] - at.first);
  if (floats <= 3 * kLanes)
    add_rows<3>(blob, prepared, k, strip, out, stride);
  else if (floats <= 4 * kLanes)
    add_rows<4>(blob, prepared, k, strip, out, stride);
  else
    add_rows<6>(blob, prepared, k, strip, out, stride);
}

// Adds a strip that is partly outside the image.  It is drawn into a buffer, and the part inside is
// copied.
[[gnu::always_inline]] inline void add_clipped(const EllipseBlob& blob,
                                               const PreparedEllipses& prepared, const Strip& at,
                                               const StripExponentials& strip,
                                               const Canvas& canvas) {
  const auto k = static_cast<std::size_t>(at.blob);
  float aside[kBandRows * kFloats] = {};
  add_strip(blob, prepared, at, strip, aside, kFloats);
  const int column = prepared.column[k] + at.first;
  for (int row = prepared.first[k]; row <= prepared.last[k]; ++row) {
    const ColumnRange inside = canvas.columns[row - canvas.first_row];
    const int left = std::max(column, inside.first);
    const int right = std::min(column + kPixels - 1, inside.last);
    if (left > right) continue;
    const float* from = aside + (row - prepared.first[k]) * kFloats + 3 * (left - column);
    float* out = canvas.at(row, left);
    for (int m = 0; m < 3 * (right - left + 1); ++m) out[m] += from[m];
  }
}

// Draws blobs batch by batch.  First come the strips that begin with the first column of their
// blobs, then the next strips of blobs that are wider than one strip, and so on.
template <bool kWide>
[[gnu::always_inline]] inline void draw_loop(const EllipseBlob* blobs, std::size_t count,
                                             const Canvas& canvas) {
  // A strip between these columns is inside the image on every row, including its padding to
  // kPixels columns.
  int least = 0, most = canvas.width - 1;
  for (int row = 0; row < canvas.rows; ++row) {
    least = std::max(least, canvas.columns[row].first);
    most = std::min(most, canvas.columns[row].last);
  }
  const std::ptrdiff_t stride = 3 * static_cast<std::ptrdiff_t>(canvas.width);
  PreparedEllipses prepared;
  std::array<Strip, kBatch> strips;
  std::array<StripExponentials, kBatch> exponentials;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t n = std::min(kBatch, count - begin);
    prepare<kWide>(blobs + begin, n, canvas, prepared);
    for (int first = 0;; first += kPixels) {
      const int listed = list_strips(prepared, n, first, strips.data());
      if (listed == 0) break;
      find_exponentials(prepared, strips.data(), listed, exponentials.data());
      for (std::size_t m = 0; m < static_cast<std::size_t>(listed); ++m) {
        const Strip& strip = strips[m];
        const auto k = static_cast<std::size_t>(strip.blob);
        const EllipseBlob& blob = blobs[begin + k];
        const int column = prepared.column[k] + strip.first;
        if (column >= least && column + kPixels - 1 <= most)
          add_strip(blob, prepared, strip, exponentials[m], canvas.at(prepared.first[k], column),
                    stride);
        else
          add_clipped(blob, prepared, strip, exponentials[m], canvas);
      }
    }
  }
}
Dispatched<draw_loop<false>> draw;
Dispatched<draw_loop<true>> draw_wide;

}  // namespace

void draw_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas) {
  draw(blobs, count, canvas);
}

void draw_wide_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas) {
  draw_wide(blobs, count, canvas);
}

}  // namespace domefall
