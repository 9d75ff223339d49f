#include "pipeline/render/blobs/cap_blob.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/render/blobs/exact_cap.h"
#include "pipeline/render/blobs/metric_shape.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Returns the most pixels per radian up to an angle `reach` from a direction that is `theta` off
// the middle.  On a dome the density along the tangent is theta/sin(theta) times that in the
// middle.  On a flat image the density is 1/cos^2(theta/2) times that in the middle.
double densest(const Projection& p, double theta, double reach) {
  const double far = std::min(theta + reach, 3.0), centre = 1 / largest_pixel_angle(p);
  if (is_domemaster(p)) return centre * std::max(1.0, far / std::sin(far));
  const double c = std::cos(far / 2);
  return centre / (c * c);
}

// Returns the argument `unit` of blob_shape().
double unit_of(const Projection& p) { return largest_pixel_angle(p) / (is_domemaster(p) ? 1 : 2); }

// Far beyond the half sphere the shape is that of a place near its edge, since blob_shape() holds
// for theta < 1.9 only.  A cap needs the shape only for its scale and for the pixel's blur.
BlobShape shape_of(const Projection& p, double cx, double cy, double sigma) {
  const double unit = unit_of(p);
  if (!is_domemaster(p)) return blob_shape<false>(unit, cx, cy, sigma);
  const double shrink = std::min(1.0, 1.7 / (unit * std::hypot(cx, cy) + 1e-300));
  return blob_shape<true>(unit, cx * shrink, cy * shrink, sigma);
}

double brightest(const CapBlob& b) { return std::max({b.rgb[0], b.rgb[1], b.rgb[2]}); }

// ---- the chord on a dome ----

// On a dome a pixel at c, in pixels from the middle, has the direction (sinc(theta) unit c, cos
// theta) with theta = unit |c|.  The chord between two close pixels is a small difference of such
// directions.  To avoid cancellation, so that floats suffice, sinc and cos are power series in the
// growth of t = theta^2 from the blob's centre.  The growth itself follows from the offset d
// between the pixels as unit^2 (2 c + d).d.

// The series have kTerms terms.  For a blob that reaches less than kNear (radians), kNearTerms are
// enough.  The terms that follow are below 1e-9.
constexpr int kTerms = 7, kNearTerms = 4;
constexpr double kNear = 0.1;

// These are the coefficients of the powers of the growth.  sinc[0] is the value at the centre.
// cosine[0] is not needed, because only the difference from the centre counts.
struct Series {
  std::array<float, kTerms> sinc, cosine;
};

// sinc(sqrt t) is the sum of (-t)^n/(2n + 1)! over n.  By Taylor's theorem, its k-th coefficient
// about t is its k-th derivative at t over k!, and kSinc[k] holds the coefficients of the powers of
// t in that.  There are enough powers for t up to 3.4 (a star beyond a dome's rim), where the
// omitted rest is below 1e-9 of the value.
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

// Since d cos(sqrt t)/dt = -sinc(sqrt t)/2, the coefficients of the cosine follow from those of
// sinc.
template <std::size_t kCount, std::size_t kPowersUsed>
Series series_about(double t) {
  std::array<double, kCount> sinc{};
  // Horner's scheme in t evaluates the polynomials of all coefficients side by side.
  for (std::size_t m = kPowersUsed; m-- > 0;)
    for (std::size_t k = 0; k < kCount; ++k) sinc[k] = sinc[k] * t + kSinc[k][m];
  Series s{};
  for (std::size_t k = 0; k < kCount; ++k) {
    s.sinc[k] = static_cast<float>(sinc[k]);
    s.cosine[k] = k > 0 ? static_cast<float>(-sinc[k - 1] / (2.0 * static_cast<double>(k))) : 0;
  }
  return s;
}

// ---- drawing ----

// A PreparedCap holds what drawing needs to know about a blob.
struct PreparedCap {
  bool dome;
  bool near;  // says whether it reaches less than kNear
  Series series;
  float cx, cy;                 // the centre, in pixels from the image's middle
  float unit, unit2;            // unit_of() and its square
  float one_plus_t;             // flat image: 1 + tan^2(theta/2) at the centre
  float chord;                  // the factor from chord2() to q
  float xx, xy, yy;             // what the pixel's blur adds to q, per pixel^2
  float slope, dent, end;       // of FlattenedGaussian, and its value at the cut
  float paling;                 // the colour is half way to white where this times the weight is 1
  std::array<float, 3> colour;  // at the peak
  std::array<float, 3> pale;    // grey of the same luminance, minus `colour`
  std::array<float, 24> colours, pales;  // both, repeated for eight pixels
};

PreparedCap prepare(const CapBlob& b, const Projection& p, float middle_x, float middle_y) {
  const double cx = b.x - middle_x, cy = b.y - middle_y, unit = unit_of(p), sigma = b.sigma;
  const BlobShape s = shape_of(p, cx, cy, sigma);
  const BlobScale scale{b.peak_per_flux, b.cut};
  const FlattenedGaussian flattened(s.flattening);
  const double t = unit * unit * (cx * cx + cy * cy);
  PreparedCap cap{};
  cap.dome = is_domemaster(p);
  cap.near = b.reach * unit < kNear;
  if (cap.dome)
    cap.series =
        cap.near ? series_about<kNearTerms, kNearPowers>(t) : series_about<kTerms, kPowers>(t);
  cap.cx = static_cast<float>(cx);
  cap.cy = static_cast<float>(cy);
  cap.unit = static_cast<float>(unit);
  cap.unit2 = static_cast<float>(unit * unit);
  cap.one_plus_t = static_cast<float>(1 + t);
  // The exponent q is the squared chord over 2 sigma^2.  chord2() leaves out a factor of unit^2,
  // and on a flat image one of 4/(1 + t).
  cap.chord = static_cast<float>((cap.dome ? 0.5 : 2 / (1 + t)) * unit * unit / (sigma * sigma));
  cap.xx = static_cast<float>((s.xx - s.bare_xx) / 2);
  cap.xy = static_cast<float>(s.xy - s.bare_xy);
  cap.yy = static_cast<float>((s.yy - s.bare_yy) / 2);
  cap.slope = static_cast<float>(flattened.slope);
  cap.dent = static_cast<float>(flattened.dent);
  cap.end = static_cast<float>(flattened(scale.cut));
  const double light = luminance({b.rgb[0], b.rgb[1], b.rgb[2]});
  // The bound keeps the square of this value finite.
  cap.paling = static_cast<float>(std::min(1e9, light * scale.peak_per_flux * b.paling));
  for (std::size_t c = 0; c < 3; ++c) {
    cap.colour[c] = static_cast<float>(b.rgb[c] * scale.peak_per_flux);
    cap.pale[c] =
        b.paling > 0 ? static_cast<float>((light - b.rgb[c]) * scale.peak_per_flux) : 0.0f;
  }
  for (std::size_t k = 0; k < 24; ++k) {
    cap.colours[k] = cap.colour[k % 3];
    cap.pales[k] = cap.pale[k % 3];
  }
  return cap;
}

// Returns the squared chord to the pixel at (dx, dy) from the centre, divided by unit^2.  On a flat
// image it is also multiplied by (1 + t)/4 with the t of the centre.  There the chord between the
// stereographic points w = unit c and w' is 2 |w - w'|/sqrt((1 + w^2)(1 + w'^2)), the chordal
// metric.
template <bool kDome, int kCount>
[[gnu::always_inline]] inline float chord2(const PreparedCap& b, float dx, float dy) {
  const float growth = b.unit2 * ((dx + 2 * b.cx) * dx + (dy + 2 * b.cy) * dy);
  if constexpr (!kDome) return (dx * dx + dy * dy) / (b.one_plus_t + growth);
  float sinc = b.series.sinc[kCount - 1], cosine = b.series.cosine[kCount - 1];
  for (std::size_t k = kCount - 1; k-- > 1;) {
    sinc = sinc * growth + b.series.sinc[k];
    cosine = cosine * growth + b.series.cosine[k];
  }
  sinc *= growth;
  cosine *= growth;
  // With t' = t + growth the two directions, over unit, differ by
  //     sinc(t') (c + d) - sinc(t) c = sinc(t) d + (sinc(t') - sinc(t)) (c + d).
  const float x = b.series.sinc[0] * dx + sinc * (b.cx + dx);
  const float y = b.series.sinc[0] * dy + sinc * (b.cy + dy);
  const float z = cosine / b.unit;
  return x * x + y * y + z * z;
}

constexpr int kChunk = 16;

// Adds `count` <= kChunk pixels of a row, of which the first lies at (dx0, dy) from the centre.
// kPale says whether the blob turns white where it is bright.
template <bool kDome, int kCount, bool kPale>
[[gnu::always_inline]] inline void add_chunk(const PreparedCap& b, float dx0, float dy, int count,
                                             float* __restrict out) {
  alignas(64) std::array<float, kChunk> weight, pale;
  for (int k = 0; k < kChunk; ++k) {
    const float dx = dx0 + static_cast<float>(k);
    const float q = b.chord * chord2<kDome, kCount>(b, dx, dy) +
                    ((b.xx * dx + b.xy * dy) * dx + b.yy * dy * dy);
    const float w = exponential_of_float(q > 0 ? -q : 0.0f);
    const float v = w * (b.slope - b.dent * w) - b.end, positive = v > 0 ? v : 0.0f;
    weight[static_cast<std::size_t>(k)] = positive;
    if constexpr (kPale) {
      const float bright = b.paling * positive, square = bright * bright;
      pale[static_cast<std::size_t>(k)] = positive * (square / (1 + square));
    }
  }
  if (count < kChunk) {
    for (int k = 0; k < count; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        float light = b.colour[c] * weight[static_cast<std::size_t>(k)];
        if constexpr (kPale) light += b.pale[c] * pale[static_cast<std::size_t>(k)];
        out[3 * k + static_cast<int>(c)] += light;
      }
    return;
  }
  Lanes v[6], g[6];
  repeat_for_channels<6>(weight.data(), v);
  if constexpr (kPale) repeat_for_channels<6>(pale.data(), g);
  for (int m = 0; m < 6; ++m) {
    Lanes sum, colour, white;
    std::memcpy(&sum, out + m * kLanes, sizeof sum);
    std::memcpy(&colour, b.colours.data() + 8 * (m % 3), sizeof colour);
    colour *= v[m];
    if constexpr (kPale) {
      std::memcpy(&white, b.pales.data() + 8 * (m % 3), sizeof white);
      colour += white * g[m];
    }
    sum += colour;
    std::memcpy(out + m * kLanes, &sum, sizeof sum);
  }
}

// Adds `count` pixels of a row.  The function may touch `room` pixels from `out` on, and adds 0 to
// those beyond the blob.
template <bool kPale>
[[gnu::always_inline]] inline void add_span_loop(const PreparedCap& b, float dx, float dy,
                                                 int count, int room, float* out) {
  for (; count > 0; count -= kChunk, room -= kChunk, dx += kChunk, out += 3 * kChunk) {
    const int pixels = std::min(room, kChunk);
    if (!b.dome)
      add_chunk<false, 0, kPale>(b, dx, dy, pixels, out);
    else if (b.near)
      add_chunk<true, kNearTerms, kPale>(b, dx, dy, pixels, out);
    else
      add_chunk<true, kTerms, kPale>(b, dx, dy, pixels, out);
  }
}
Dispatched<add_span_loop<false>> add_span;
Dispatched<add_span_loop<true>> add_pale_span;

}  // namespace

bool place_cap(const Projection& projection, CapBlob& blob) {
  if (!has_blob_loops(projection)) return place_exact_cap(projection, blob);
  blob.first_row = blob.first_column = 0;
  blob.last_row = blob.last_column = -1;
  const double width = columns(projection), height = rows(projection);
  const double cx = blob.x - (width - 1) / 2, cy = blob.y - (height - 1) / 2;
  const double from_middle = std::hypot(cx, cy) * unit_of(projection);
  const bool dome = is_domemaster(projection);
  const double theta = dome ? from_middle : 2 * std::atan(from_middle);
  const BlobScale scale = blob_scale(shape_of(projection, cx, cy, blob.sigma), brightest(blob));
  const double q = std::sqrt(-2 * logarithm(scale.cut)), chord = q * blob.sigma;
  const double reach = 2 * std::asin(std::min(1.0, chord / 2));
  if (theta - reach > (dome ? pi / 2 + 2 * unit_of(projection) : 0.999 * pi) ||
      (!dome && theta + reach > 0.999 * pi))
    return false;
  // The blur by the pixel has the variance 1/12.  It extends the blob by less than q of its sigmas.
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
  if (!has_blob_loops(projection)) return draw_exact_cap(blob, projection, canvas);
  const int first = std::max(blob.first_row, canvas.first_row);
  const int last = std::min(blob.last_row, canvas.first_row + canvas.rows - 1);
  if (first > last) return;
  const PreparedCap cap = prepare(blob, projection, static_cast<float>(columns(projection) - 1) / 2,
                                  static_cast<float>(rows(projection) - 1) / 2);
  for (int row = first; row <= last; ++row) {
    const ColumnRange inside = canvas.columns[row - canvas.first_row];
    const float dy = static_cast<float>(row) - blob.y;
    const float half = std::sqrt(std::max(0.0f, blob.reach * blob.reach - dy * dy)) + 1;
    const int left = std::max({blob.first_column, inside.first, static_cast<int>(blob.x - half)});
    const int right =
        std::min({blob.last_column, inside.last, static_cast<int>(blob.x + half) + 1});
    if (left > right) continue;
    const float dx = static_cast<float>(left) - blob.x;
    const int count = right - left + 1, room = inside.last - left + 1;
    if (cap.paling > 0)
      add_pale_span(cap, dx, dy, count, room, canvas.at(row, left));
    else
      add_span(cap, dx, dy, count, room, canvas.at(row, left));
  }
}

}  // namespace domefall
