#include "pipeline/render/blobs/cap_blob.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "pipeline/colour/colour_space.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Pixels per radian at most, up to an angle `reach` from a direction `theta` off the middle.
double densest(const Projection& p, double theta, double reach) {
  const double far = std::min(theta + reach, 3.0), centre = 1 / central_pixel_angle(p);
  if (std::holds_alternative<Domemaster>(p)) return centre * std::max(1.0, far / std::sin(far));
  const double c = std::cos(far / 2);
  return centre / (c * c);
}

bool is_dome(const Projection& p) { return std::holds_alternative<Domemaster>(p); }

double unit_of(const Projection& p) { return central_pixel_angle(p) / (is_dome(p) ? 1 : 2); }

// Beyond the half sphere the shape is that at its edge; it matters for the pixel's blur only.
BlobShape shape_of(const Projection& p, double cx, double cy, double sigma) {
  const double unit = unit_of(p);
  if (!is_dome(p)) return blob_shape<false>(unit, cx, cy, sigma);
  const double shrink = std::min(1.0, 1.7 / (unit * std::hypot(cx, cy) + 1e-300));
  return blob_shape<true>(unit, cx * shrink, cy * shrink, sigma);
}

double brightest(const CapBlob& b) { return std::max({b.rgb[0], b.rgb[1], b.rgb[2]}); }

// ---- one row ----

// Powers of the growth: all of them, and what a blob needs that reaches less than kNear (radians),
// where the next term is below 1e-9.
constexpr int kTerms = 7, kNearTerms = 4;
constexpr double kNear = 0.1;

// In units of the picture's `unit`: sinc theta and cos theta about the centre, as series in the growth
// of theta^2, so that nothing cancels and float suffices.
struct Series {
  std::array<float, kTerms> sinc, cosine;  // sinc[0] is the value itself; cosine[0] is left out
};

// sinc(sqrt t) = sum over n of (-t)^n / (2n + 1)!; its k-th derivative over k! has the coefficients
// kSinc[k][m] of t^m.
constexpr int kPowers = 15, kNearPowers = 10;
constexpr auto kSinc = [] {
  std::array<std::array<double, kPowers>, kTerms> table{};
  for (int k = 0; k < kTerms; ++k) {
    double reciprocal = 1, binomial = 1;  // +-1 / (2n + 1)!; n over k
    for (int n = 1; n <= k; ++n) reciprocal /= -(2.0 * n) * (2.0 * n + 1);
    for (int m = 0; m < kPowers; ++m) {
      const int n = k + m;
      table[static_cast<std::size_t>(k)][static_cast<std::size_t>(m)] = reciprocal * binomial;
      reciprocal /= -(2.0 * n + 2) * (2.0 * n + 3);
      binomial *= (n + 1.0) / (m + 1);
    }
  }
  return table;
}();

// For t up to 3.4 (a star beyond a dome's rim); what is left out is below 1e-9 of sinc's part.
template <std::size_t kCount, std::size_t kPowersUsed>
Series series_about(double t) {
  std::array<double, kCount> sinc{};
  for (std::size_t m = kPowersUsed; m-- > 0;)
    for (std::size_t k = 0; k < kCount; ++k) sinc[k] = sinc[k] * t + kSinc[k][m];
  Series s{};
  for (std::size_t k = 0; k < kCount; ++k) {
    s.sinc[k] = static_cast<float>(sinc[k]);
    s.cosine[k] = k > 0 ? static_cast<float>(-sinc[k - 1] / (2.0 * static_cast<double>(k))) : 0;
  }
  return s;
}

// A blob ready to be drawn.
struct Brush {
  bool dome, near;
  Series series;
  float cx, cy, unit, unit2;  // the centre from the picture's middle
  float one_plus_w2;          // flat: 1 + tan^2(theta/2) at the centre
  float chord;                // chord^2 to q
  float xx, xy, yy;           // the pixel's blur: what it adds to q, per pixel^2
  float slope, dent, end;     // FlatGaussian, and its value at the cut
  float paling;               // times v: 1 where the colour is half way to white
  std::array<float, 3> colour, pale;
  std::array<float, 24> colours, pales;  // eight times
};

Brush brush_of(const CapBlob& b, const Projection& p, float middle_x, float middle_y) {
  const double cx = b.x - middle_x, cy = b.y - middle_y, unit = unit_of(p), sigma = b.sigma;
  const BlobShape s = shape_of(p, cx, cy, sigma);
  const BlobScale scale{b.peak_per_flux, b.cut};
  const FlatGaussian flat(s.flat);
  const double t = unit * unit * (cx * cx + cy * cy);
  Brush brush{};
  brush.dome = is_dome(p), brush.near = b.reach * unit < kNear;
  if (brush.dome)
    brush.series =
        brush.near ? series_about<kNearTerms, kNearPowers>(t) : series_about<kTerms, kPowers>(t);
  brush.cx = static_cast<float>(cx), brush.cy = static_cast<float>(cy);
  brush.unit = static_cast<float>(unit), brush.unit2 = static_cast<float>(unit * unit);
  brush.one_plus_w2 = static_cast<float>(1 + t);
  brush.chord =
      static_cast<float>((brush.dome ? 0.5 : 2 / (1 + t)) * unit * unit / (sigma * sigma));
  brush.xx = static_cast<float>((s.xx - s.bare_xx) / 2);
  brush.xy = static_cast<float>(s.xy - s.bare_xy);
  brush.yy = static_cast<float>((s.yy - s.bare_yy) / 2);
  brush.slope = static_cast<float>(flat.slope), brush.dent = static_cast<float>(flat.dent);
  brush.end = static_cast<float>(flat(scale.cut));
  const double light = luminance({b.rgb[0], b.rgb[1], b.rgb[2]});
  // Bounded so that its square is finite.
  brush.paling = static_cast<float>(std::min(1e9, light * scale.peak_per_flux * b.paling));
  for (std::size_t c = 0; c < 3; ++c) {
    brush.colour[c] = static_cast<float>(b.rgb[c] * scale.peak_per_flux);
    brush.pale[c] =
        b.paling > 0 ? static_cast<float>((light - b.rgb[c]) * scale.peak_per_flux) : 0.0f;
  }
  for (std::size_t k = 0; k < 24; ++k)
    brush.colours[k] = brush.colour[k % 3], brush.pales[k] = brush.pale[k % 3];
  return brush;
}

// chord^2 / unit^2 (on a flat picture times (1 + w0^2)/4) to a pixel (dx, dy) from the centre.
template <bool kDome, int kCount>
[[gnu::always_inline]] inline float chord2(const Brush& b, float dx, float dy) {
  const float growth = b.unit2 * ((dx + 2 * b.cx) * dx + (dy + 2 * b.cy) * dy);
  if constexpr (!kDome) return (dx * dx + dy * dy) / (b.one_plus_w2 + growth);
  float sinc = b.series.sinc[kCount - 1], cosine = b.series.cosine[kCount - 1];
  for (std::size_t k = kCount - 1; k-- > 1;)
    sinc = sinc * growth + b.series.sinc[k], cosine = cosine * growth + b.series.cosine[k];
  sinc *= growth, cosine *= growth;
  const float x = b.series.sinc[0] * dx + sinc * (b.cx + dx);
  const float y = b.series.sinc[0] * dy + sinc * (b.cy + dy), z = cosine / b.unit;
  return x * x + y * y + z * z;
}

constexpr int kChunk = 16;

template <bool kDome, int kCount>
[[gnu::always_inline]] inline void add_chunk(const Brush& b, float dx0, float dy, int count,
                                             float* __restrict out) {
  alignas(64) std::array<float, kChunk> weight, pale;
  for (int k = 0; k < kChunk; ++k) {
    const float dx = dx0 + static_cast<float>(k);
    const float q = b.chord * chord2<kDome, kCount>(b, dx, dy) +
                    ((b.xx * dx + b.xy * dy) * dx + b.yy * dy * dy);
    const float w = exponential_of_float(q > 0 ? -q : 0.0f);
    const float v = w * (b.slope - b.dent * w) - b.end, positive = v > 0 ? v : 0.0f;
    const float bright = b.paling * positive, square = bright * bright;
    weight[static_cast<std::size_t>(k)] = positive;
    pale[static_cast<std::size_t>(k)] = positive * (square / (1 + square));
  }
  if (count < kChunk) {
    for (int k = 0; k < count; ++k) {
      const float v = weight[static_cast<std::size_t>(k)], g = pale[static_cast<std::size_t>(k)];
      for (std::size_t c = 0; c < 3; ++c)
        out[3 * k + static_cast<int>(c)] += b.colour[c] * v + b.pale[c] * g;
    }
    return;
  }
  Lanes v[6], g[6];
  repeat_for_channels<6>(weight.data(), v);
  repeat_for_channels<6>(pale.data(), g);
  for (int m = 0; m < 6; ++m) {
    Lanes sum, colour, white;
    std::memcpy(&sum, out + m * kLanes, sizeof sum);
    std::memcpy(&colour, b.colours.data() + 8 * (m % 3), sizeof colour);
    std::memcpy(&white, b.pales.data() + 8 * (m % 3), sizeof white);
    sum += colour * v[m] + white * g[m];
    std::memcpy(out + m * kLanes, &sum, sizeof sum);
  }
}

// `room`: pixels from out on that may be touched; beyond the blob they get 0.
[[gnu::always_inline]] inline void add_span_loop(const Brush& b, float dx, float dy, int count,
                                                 int room, float* out) {
  for (; count > 0; count -= kChunk, room -= kChunk, dx += kChunk, out += 3 * kChunk) {
    const int pixels = std::min(room, kChunk);
    if (!b.dome)
      add_chunk<false, 0>(b, dx, dy, pixels, out);
    else if (b.near)
      add_chunk<true, kNearTerms>(b, dx, dy, pixels, out);
    else
      add_chunk<true, kTerms>(b, dx, dy, pixels, out);
  }
}
Dispatched<add_span_loop> add_span;

}  // namespace

bool place_cap(const Projection& projection, CapBlob& blob) {
  blob.first_row = blob.first_column = 0;
  blob.last_row = blob.last_column = -1;
  const double width = columns(projection), height = rows(projection);
  const double cx = blob.x - (width - 1) / 2, cy = blob.y - (height - 1) / 2;
  const double from_middle = std::hypot(cx, cy) * unit_of(projection);
  const bool dome = is_dome(projection);
  const double theta = dome ? from_middle : 2 * std::atan(from_middle);
  const BlobScale scale = blob_scale(shape_of(projection, cx, cy, blob.sigma), brightest(blob));
  const double q = std::sqrt(-2 * logarithm(scale.cut)), chord = q * blob.sigma;
  const double reach = 2 * std::asin(std::min(1.0, chord / 2));
  if (theta - reach > (dome ? pi / 2 + 2 * unit_of(projection) : 0.999 * pi) ||
      (!dome && theta + reach > 0.999 * pi))
    return false;
  const double half = reach * densest(projection, theta, reach) + q * std::sqrt(1.0 / 12) + 1;
  if (!(blob.x + half >= 0 && blob.y + half >= 0 && blob.x - half <= width - 1 &&
        blob.y - half <= height - 1))
    return false;
  const auto within = [](double v, double last) {
    return static_cast<int>(std::clamp(v, 0.0, last));
  };
  blob.reach = static_cast<float>(half);
  blob.peak_per_flux = static_cast<float>(scale.peak_per_flux);
  blob.cut = static_cast<float>(scale.cut);
  blob.first_row = within(std::ceil(blob.y - half), height - 1);
  blob.last_row = within(std::floor(blob.y + half), height - 1);
  blob.first_column = within(std::ceil(blob.x - half), width - 1);
  blob.last_column = within(std::floor(blob.x + half), width - 1);
  return true;
}

void draw_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas) {
  const int first = std::max(blob.first_row, canvas.first_row);
  const int last = std::min(blob.last_row, canvas.first_row + canvas.rows - 1);
  if (first > last) return;
  const Brush brush = brush_of(blob, projection, static_cast<float>(columns(projection) - 1) / 2,
                               static_cast<float>(rows(projection) - 1) / 2);
  for (int row = first; row <= last; ++row) {
    const ColumnRange inside = canvas.columns[row - canvas.first_row];
    const float dy = static_cast<float>(row) - blob.y;
    const float half = std::sqrt(std::max(0.0f, blob.reach * blob.reach - dy * dy)) + 1;
    const int left = std::max({blob.first_column, inside.first, static_cast<int>(blob.x - half)});
    const int right =
        std::min({blob.last_column, inside.last, static_cast<int>(blob.x + half) + 1});
    if (left > right) continue;
    add_span(brush, static_cast<float>(left) - blob.x, dy, right - left + 1, inside.last - left + 1,
             canvas.at(row, left));
  }
}

}  // namespace domefall
