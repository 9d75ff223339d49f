#include "pipeline/render/blobs/ellipse_blob.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

// A blob is drawn in parts of so many columns, three blocks of floats.
constexpr int kPixels = 16, kFloats = 3 * kPixels;
constexpr int kBlock = 16;
using Block = float __attribute__((vector_size(4 * kBlock)));
constexpr std::size_t kBatch = 32;

// ---- placing ----

constexpr int kNowhere = static_cast<int>(Placed::kNowhere),
              kEllipse = static_cast<int>(Placed::kEllipse), kCap = static_cast<int>(Placed::kCap);

struct Frame {
  double unit, middle_x, middle_y, width, height, most_peak;
};

// A batch of images side by side, in and out.
struct Placing {
  alignas(64) std::array<double, kBatch> x, y, red, green, blue, sigma;
  alignas(64) std::array<float, kBatch> xx, xy, yy, peak_per_flux;
  alignas(64) std::array<int, kBatch> what, first_row;
};

template <bool kDome>
[[gnu::always_inline]] inline void place(const Frame& f, Placing& p) {
  for (std::size_t k = 0; k < kBatch; ++k) {
    const double cx = p.x[k] - f.middle_x, cy = p.y[k] - f.middle_y;
    // Far outside the half sphere the ellipses grow without bound; wide blobs know what to do there.
    const bool far = kDome && f.unit * f.unit * (cx * cx + cy * cy) > 3;
    const BlobShape s = blob_shape<kDome>(f.unit, far ? 0 : cx, far ? 0 : cy, p.sigma[k]);
    const double warm = p.red[k] > p.green[k] ? p.red[k] : p.green[k];
    const double brightest = warm > p.blue[k] ? warm : p.blue[k];
    const BlobScale scale = blob_scale(s, brightest);
    // Drawing takes a logarithm that is up to 1 % larger.
    const double q = -2.02 * logarithm(scale.cut);
    const double half_x = std::sqrt(q * s.spread_x), half_y = std::sqrt(q * s.spread_y);
    // Selections, which become SIMD code, not branches.
    const double half = half_x > half_y ? half_x : half_y;
    const double from_left = p.x[k] + half_x, from_top = p.y[k] + half_y;
    const double to_right = f.width - 1 - (p.x[k] - half_x);
    const double to_bottom = f.height - 1 - (p.y[k] - half_y);
    const double across = from_left < to_right ? from_left : to_right;
    const double down = from_top < to_bottom ? from_top : to_bottom;
    int what = brightest * scale.peak_per_flux > f.most_peak ? kCap : kEllipse;
    what = s.bend > kMostBend ? kCap : what;
    what = 2 * half > kMostEllipsePixels - 1 ? kCap : what;
    what = (across < down ? across : down) < 0 ? kNowhere : what;
    p.what[k] = far ? kCap : what;
    p.first_row[k] = static_cast<int>(p.y[k] - half_y + 64) - 64;  // rounded down
    p.xx[k] = static_cast<float>(s.xx), p.xy[k] = static_cast<float>(s.xy);
    p.yy[k] = static_cast<float>(s.yy);
    p.peak_per_flux[k] = static_cast<float>(scale.peak_per_flux);
  }
}

Dispatched<place<true>> place_on_dome;
Dispatched<place<false>> place_on_flat;

void place_batch(const Frame& f, bool dome, const StarImage* images, const double* sigma,
                 std::size_t count, EllipseBlob* blobs, int* first_row, Placed* kind) {
  Placing p;
  for (std::size_t k = 0; k < kBatch; ++k) {
    const StarImage& image = images[std::min(k, count - 1)];
    p.x[k] = image.x, p.y[k] = image.y, p.sigma[k] = sigma[std::min(k, count - 1)];
    p.red[k] = image.rgb[0], p.green[k] = image.rgb[1], p.blue[k] = image.rgb[2];
  }
  if (dome)
    place_on_dome(f, p);
  else
    place_on_flat(f, p);
  for (std::size_t k = 0; k < count; ++k) {
    const StarImage& image = images[k];
    const float scale = p.peak_per_flux[k];
    blobs[k] = {image.x, image.y,
                p.xx[k], p.xy[k],
                p.yy[k], {image.rgb[0] * scale, image.rgb[1] * scale, image.rgb[2] * scale}};
    first_row[k] = p.first_row[k];
    kind[k] = static_cast<Placed>(p.what[k]);
  }
}

// ---- drawing ----

// -ln x, or up to 0.06 more: the mantissa is taken for its logarithm.
[[gnu::always_inline]] inline float about_minus_log(float x) {
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x)) * 0x1p-23f;
  return (127.0f - bits) * 0.69314718f;
}

// What drawing needs of a batch of blobs, computed for all at once.  Pixels count from 0.
struct Batch {
  alignas(64) std::array<float, kBatch> dx, dy;  // from the centre to the box's first pixel
  alignas(64) std::array<float, kBatch> xx, xy, yy, part, gain, end;
  alignas(64) std::array<int, kBatch> column, columns, first, last;  // rows within the canvas
};

// With u = part W, part = dent/slope of FlatGaussian, its value is slope/part (u - u^2).
[[gnu::always_inline]] inline void prepare(const EllipseBlob* blobs, std::size_t count,
                                           const Canvas& canvas, Batch& batch) {
  constexpr int kMargin = 64;  // makes numbers positive, so that truncation rounds down
  const int first_row = canvas.first_row, end_row = canvas.first_row + canvas.rows - 1;
  for (std::size_t k = 0; k < count; ++k) {
    const EllipseBlob& b = blobs[k];
    const float warm = b.rgb[0] > b.rgb[1] ? b.rgb[0] : b.rgb[1];
    const float peak = warm > b.rgb[2] ? warm : b.rgb[2];
    const float low = static_cast<float>(kUnseen) / peak;
    const auto highest = static_cast<float>(kHighestCut), lowest = static_cast<float>(kLowestCut);
    const float high = low < highest ? low : highest, cut = high > lowest ? high : lowest;
    const float spread = 2 * about_minus_log(cut) / (b.xx * b.yy - b.xy * b.xy);
    const float half_x = std::sqrt(spread * b.yy), half_y = std::sqrt(spread * b.xx);
    const int left = static_cast<int>(b.x - half_x + kMargin) - (kMargin - 1);
    const int right = static_cast<int>(b.x + half_x + kMargin) - kMargin;
    const int top = static_cast<int>(b.y - half_y + kMargin) - (kMargin - 1);
    const int bottom = static_cast<int>(b.y + half_y + kMargin) - kMargin;
    const int first = top > first_row ? top : first_row;
    const float flat = (b.xx * b.xx + b.yy * b.yy) * static_cast<float>(1.0 / 5760);
    const float slope = 1 + 7.5f * flat, dent = 13.5f * flat, part = dent / slope;
    batch.column[k] = left;
    batch.columns[k] = right - left + 1;
    batch.first[k] = first;
    batch.last[k] = bottom < end_row ? bottom : end_row;
    batch.dx[k] = static_cast<float>(left) - b.x, batch.dy[k] = static_cast<float>(first) - b.y;
    batch.xx[k] = -0.5f * b.xx, batch.xy[k] = -b.xy, batch.yy[k] = -0.5f * b.yy;
    batch.part[k] = part, batch.gain[k] = slope / part;
    batch.end[k] = part * cut * (1 - part * cut);
  }
}

// Pixels' values for their three channels each, from 16 pixels.
template <int kCount>
[[gnu::always_inline]] inline void in_blocks(const float* pixels, Block* blocks) {
  Lanes floats[6];
  repeat_for_channels<2 * kCount>(pixels, floats);
  for (int m = 0; m < kCount; ++m)
    blocks[m] = __builtin_shufflevector(floats[2 * m], floats[2 * m + 1], 0, 1, 2, 3, 4, 5, 6, 7, 8,
                                        9, 10, 11, 12, 13, 14, 15);
}

using BlockBits = std::int32_t __attribute__((vector_size(4 * kBlock)));

// The larger of v and 0; a float's bits are in order above 0, and below it negative.
[[gnu::always_inline]] inline void keep_positive(Block& v) {
  BlockBits bits;
  std::memcpy(&bits, &v, sizeof v);
  bits = bits > 0 ? bits : BlockBits{};
  std::memcpy(&v, &bits, sizeof v);
}

// A blob's columns from `first` on, as many as one part draws, and what it is made of: its exponentials.
struct Part {
  alignas(64) float weight[kPixels], step[kPixels], rows[kPixels];
};
struct PartOf {
  int blob, column;
};

[[gnu::always_inline]] inline void find_exponentials(const Batch& batch, const PartOf* of,
                                                     int count, Part* parts) {
  static_assert(kMostCanvasRows <= kPixels);
  for (int n = 0; n < count; ++n) {
    const auto k = static_cast<std::size_t>(of[n].blob);
    const float x0 = batch.dx[k] + static_cast<float>(of[n].column), y0 = batch.dy[k],
                xx = batch.xx[k], xy = batch.xy[k], yy = batch.yy[k], along = xy * y0,
                scale = batch.part[k];
    Part& part = parts[n];
    for (int m = 0; m < kPixels; ++m) {
      const float dx = x0 + static_cast<float>(m), dy = y0 + static_cast<float>(m);
      part.weight[m] = exponential_of_float((xx * dx + along) * dx);
      part.step[m] = exponential_of_float(xy * dx);
      part.rows[m] = scale * exponential_of_float(yy * dy * dy);
    }
  }
}

// Adds a blob's rows to out, whose first float is that of its first pixel.  From row to row W changes
// by exp(-xy dx) along the columns, and by a factor common to the row.
template <int kCount>
[[gnu::always_inline]] inline void add_rows(const EllipseBlob& blob, const Batch& batch,
                                            std::size_t k, const Part& part, float* __restrict out,
                                            std::ptrdiff_t stride) {
  Block weight[3], step[3], scale[3];
  in_blocks<kCount>(part.weight, weight), in_blocks<kCount>(part.step, step);
  const float gain = batch.gain[k], r = gain * blob.rgb[0], g = gain * blob.rgb[1],
              b = gain * blob.rgb[2], end = batch.end[k];
  scale[0] = Block{r, g, b, r, g, b, r, g, b, r, g, b, r, g, b, r};
  scale[1] = Block{g, b, r, g, b, r, g, b, r, g, b, r, g, b, r, g};
  scale[2] = Block{b, r, g, b, r, g, b, r, g, b, r, g, b, r, g, b};
  for (int j = 0; j <= batch.last[k] - batch.first[k]; ++j, out += stride) {
    const float row = part.rows[j];
    for (int m = 0; m < kCount; ++m) {
      const Block u = weight[m] * row;
      Block v = (u - u * u) - end;
      keep_positive(v);
      Block sum;
      std::memcpy(&sum, out + m * kBlock, sizeof sum);
      sum += scale[m] * v;
      std::memcpy(out + m * kBlock, &sum, sizeof sum);
      weight[m] *= step[m];
    }
  }
}

// Adds a part to out, where its first pixel is.
[[gnu::always_inline]] inline void add_part(const EllipseBlob& blob, const Batch& batch,
                                            const PartOf& of, const Part& part, float* out,
                                            std::ptrdiff_t stride) {
  const auto k = static_cast<std::size_t>(of.blob);
  if (3 * (batch.columns[k] - of.column) <= 2 * kBlock)
    add_rows<2>(blob, batch, k, part, out, stride);
  else
    add_rows<3>(blob, batch, k, part, out, stride);
}

// Where some of the part is outside: drawn aside, and what is inside copied.
[[gnu::always_inline]] inline void add_clipped(const EllipseBlob& blob, const Batch& batch,
                                               const PartOf& of, const Part& part,
                                               const Canvas& canvas) {
  const auto k = static_cast<std::size_t>(of.blob);
  float aside[kMostCanvasRows * kFloats] = {};
  add_part(blob, batch, of, part, aside, kFloats);
  const int column = batch.column[k] + of.column;
  for (int row = batch.first[k]; row <= batch.last[k]; ++row) {
    const ColumnRange inside = canvas.columns[row - canvas.first_row];
    const int left = std::max(column, inside.first);
    const int right = std::min(column + kPixels - 1, inside.last);
    if (left > right) continue;
    const float* from = aside + (row - batch.first[k]) * kFloats + 3 * (left - column);
    float* out = canvas.at(row, left);
    for (int m = 0; m < 3 * (right - left + 1); ++m) out[m] += from[m];
  }
}

}  // namespace

void place_ellipses(const Projection& projection, const StarImage* images, const double* sigma,
                    std::size_t count, double most_peak, EllipseBlob* blobs, int* first_row,
                    Placed* kind) {
  const bool dome = std::holds_alternative<Domemaster>(projection);
  const double width = columns(projection), height = rows(projection);
  const double unit = central_pixel_angle(projection) / (dome ? 1 : 2);
  const Frame frame{unit, (width - 1) / 2, (height - 1) / 2, width, height, most_peak};
  for (std::size_t k = 0; k < count; k += kBatch)
    place_batch(frame, dome, images + k, sigma + k, std::min(kBatch, count - k), blobs + k,
                first_row + k, kind + k);
}

namespace {

[[gnu::always_inline]] inline void draw_loop(const EllipseBlob* blobs, std::size_t count,
                                             const Canvas& canvas) {
  // A box within these columns is inside on every row, the padding to whole blocks included.
  int least = 0, most = canvas.width - 1;
  for (int row = 0; row < canvas.rows; ++row) {
    least = std::max(least, canvas.columns[row].first);
    most = std::min(most, canvas.columns[row].last);
  }
  const std::ptrdiff_t stride = 3 * static_cast<std::ptrdiff_t>(canvas.width);
  Batch batch;
  std::array<PartOf, 2 * kBatch> of;
  std::array<Part, 2 * kBatch> parts;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t n = std::min(kBatch, count - begin);
    prepare(blobs + begin, n, canvas, batch);
    int listed = 0;
    bool wide = false;
    for (std::size_t k = 0; k < n; ++k) {
      of[static_cast<std::size_t>(listed)] = {static_cast<int>(k), 0};
      const bool seen = batch.first[k] <= batch.last[k];
      listed += seen ? 1 : 0;
      wide |= seen && batch.columns[k] > kPixels;
    }
    for (std::size_t k = 0; k < n && wide; ++k)
      if (batch.first[k] <= batch.last[k] && batch.columns[k] > kPixels)
        of[static_cast<std::size_t>(listed++)] = {static_cast<int>(k), kPixels};
    find_exponentials(batch, of.data(), listed, parts.data());
    for (int m = 0; m < listed; ++m) {
      const PartOf& one = of[static_cast<std::size_t>(m)];
      const auto k = static_cast<std::size_t>(one.blob);
      const EllipseBlob& blob = blobs[begin + k];
      const int column = batch.column[k] + one.column;
      if (column >= least && column + kPixels - 1 <= most)
        add_part(blob, batch, one, parts[static_cast<std::size_t>(m)],
                 canvas.at(batch.first[k], column), stride);
      else
        add_clipped(blob, batch, one, parts[static_cast<std::size_t>(m)], canvas);
    }
  }
}
Dispatched<draw_loop> draw;

}  // namespace

void draw_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas) {
  draw(blobs, count, canvas);
}

}  // namespace domefall
