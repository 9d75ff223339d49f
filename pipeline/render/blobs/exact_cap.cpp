#include "pipeline/render/blobs/exact_cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/scene/point_spread.h"
#include "pipeline/sources/colour/colour_space.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

using std::numbers::pi;

CameraDirection middle_of(const CapBlob& b, const Projection& p) {
  return direction_at(p, {b.x + 1.0, b.y + 1.0});
}

// Returns the angle (radians) from its middle at which a cap ends.  Its cut must be set.
double angle_of(const CapBlob& b) {
  const double chord = std::sqrt(-2 * logarithm(double{b.cut})) * b.sigma;
  return 2 * std::asin(std::min(1.0, chord / 2));
}

// Returns the integral over the sphere of exp(-q) - cut, where q = c^2/(2 sigma^2) and c is the
// chord.  A cap out to the chord c = 2 sin(theta/2) has the solid angle 2 pi (1 - cos theta) = pi
// c^2, which is 2 pi sigma^2 per unit of q.  The sphere ends at the opposite point, where c = 2.
double integral_of_weight(double sigma, double cut) {
  const double last = std::min(-logarithm(cut), 2 / (sigma * sigma));
  return 2 * pi * sigma * sigma * (1 - exponential(-last) - cut * last);
}

// ---- drawing ----

constexpr int kPixelsAtOnce = 32, kMostPoints = 2;

// Gauss' quadrature along a side of a pixel has these points, counted from the pixel's middle.  Two
// points average a function f with the error f''''/4320, and one point with the error f''/24.  For
// a Gaussian of width s (pixels) these errors are at most 3/(4320 s^4) and 1/(24 s^2) of its peak
// along each axis.
struct Points {
  std::size_t count;
  std::array<double, kMostPoints> at;
};
constexpr double kGauss = 0.28867513459481287;  // 1 / (2 sqrt 3)
constexpr Points kOnePoint{1, {0}}, kTwoPoints{2, {-kGauss, kGauss}};
constexpr double kWide = 6;  // pixels; for a Gaussian as wide as this, one point is enough

// A Weighing says about which middle and with which width directions are weighted.
struct Weighing {
  V3d middle;
  double per_chord2;  // 1/(2 sigma^2)
  float cut;
};

// Sets the weights of directions, minus the cut.
[[gnu::always_inline]] inline void weigh_loop(const Weighing& weighing, const CameraDirection* n,
                                              int count, float* __restrict weight) {
  const Weighing w = weighing;
  for (int k = 0; k < count; ++k) {
    const double x = n[k].v.x - w.middle.x, y = n[k].v.y - w.middle.y, z = n[k].v.z - w.middle.z;
    const auto q = static_cast<float>((x * x + y * y + z * z) * w.per_chord2);
    const float v = exponential_of_float(q < 80 ? -q : -80.0f) - w.cut;
    weight[k] = v > 0 ? v : 0.0f;
  }
}
Dispatched<weigh_loop> weigh;

class ExactCap {
 public:
  ExactCap(const CapBlob& blob, const Projection& projection)
      : projection_(projection),
        wide_(blob.sigma > kWide * largest_pixel_angle(projection)),
        weighing_{middle_of(blob, projection).v, 1 / (2 * double{blob.sigma} * blob.sigma),
                  blob.cut} {
    const auto light =
        static_cast<float>(luminance({blob.rgb[0], blob.rgb[1], blob.rgb[2]})) * blob.peak_per_flux;
    // The bound keeps the square of this value finite.
    paling_ = std::min(1e9f, light * blob.paling);
    for (std::size_t c = 0; c < 3; ++c) {
      colour_[c] = blob.rgb[c] * blob.peak_per_flux;
      pale_[c] = blob.paling > 0 ? light - colour_[c] : 0.0f;
    }
  }

  void add(int row, int first, int last, float* out) const {
    for (int from = first; from <= last; from += kPixelsAtOnce) {
      const int count = std::min(kPixelsAtOnce, last - from + 1);
      const std::array<float, kPixelsAtOnce> weight = weights(row, from, count);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k, out += 3)
        add_light(weight[k], out);
    }
  }

 private:
  // Returns the mean weights of some pixels of a row.  Each point counts by the area for which it
  // stands, since beside a pole this area changes within a pixel.
  std::array<float, kPixelsAtOnce> weights(int row, int from, int count) const {
    constexpr std::size_t kMost =
        static_cast<std::size_t>(kPixelsAtOnce) * kMostPoints * kMostPoints;
    std::array<double, kMost> i, j, angle;
    std::array<CameraDirection, kMost> n;
    std::array<float, kMost> of_point, area;
    const Points& points = wide_ && !has_slanted_areas(projection_, row) ? kOnePoint : kTwoPoints;
    const auto pixels = static_cast<std::size_t>(count);
    std::size_t all = 0;
    for (std::size_t down = 0; down < points.count; ++down)
      for (std::size_t across = 0; across < points.count; ++across, all += pixels)
        for (std::size_t k = 0; k < pixels; ++k) {
          i[all + k] = from + static_cast<double>(k) + 1 + points.at[across];
          j[all + k] = row + 1 + points.at[down];
        }
    const auto number = static_cast<int>(all);
    find_directions(projection_, i.data(), j.data(), number, n.data(), angle.data());
    weigh(weighing_, n.data(), number, of_point.data());
    find_areas(projection_, n.data(), i.data(), j.data(), number, area.data());
    std::array<float, kPixelsAtOnce> light{}, whole{};
    for (std::size_t point = 0; point < all; point += pixels)
      for (std::size_t k = 0; k < pixels; ++k) {
        light[k] += area[point + k] * of_point[point + k];
        whole[k] += area[point + k];
      }
    for (std::size_t k = 0; k < pixels; ++k) light[k] /= whole[k];
    return light;
  }

  void add_light(float weight, float* out) const {
    if (weight == 0) return;
    const float bright = paling_ * weight, square = bright * bright;
    const float pale = weight * (square / (1 + square));
    for (std::size_t c = 0; c < 3; ++c) out[c] += colour_[c] * weight + pale_[c] * pale;
  }

  const Projection& projection_;
  bool wide_;
  Weighing weighing_;
  float paling_ = 0;             // the colour is half white where this times the weight is 1
  std::array<float, 3> colour_;  // at the peak
  std::array<float, 3> pale_;    // grey of the same luminance, minus the colour
};

}  // namespace

bool place_exact_cap(const Projection& projection, CapBlob& blob) {
  blob.first_row = blob.first_column = 0;
  blob.last_row = blob.last_column = -1;
  const double sigma = blob.sigma, light = std::max({blob.rgb[0], blob.rgb[1], blob.rgb[2]});
  // The cut follows from the peak, and the peak from the integral that the cut leaves.  The first
  // integral has practically no cut, and one more round suffices, as in blob_scale().
  const double whole = light / integral_of_weight(sigma, 0x1p-1000);
  const double first = light / integral_of_weight(sigma, cut_of(whole));
  blob.cut = static_cast<float>(cut_of(first));
  blob.peak_per_flux = static_cast<float>(1 / integral_of_weight(sigma, double{blob.cut}));
  const auto box = cap_box(projection, middle_of(blob, projection), angle_of(blob));
  const double width = columns(projection), height = rows(projection);
  if (!box || !(blob.x + box->right >= 0 && blob.y + box->down >= 0 &&
                blob.x - box->left <= width - 1 && blob.y - box->up <= height - 1))
    return false;
  const auto within = [](double v, double last) {
    return static_cast<int>(std::clamp(v, 0.0, last));
  };
  blob.reach = static_cast<float>(box->reach);
  blob.first_row = within(std::ceil(blob.y - box->up), height - 1);
  blob.last_row = within(std::floor(blob.y + box->down), height - 1);
  blob.first_column = within(std::ceil(blob.x - box->left), width - 1);
  blob.last_column = within(std::floor(blob.x + box->right), width - 1);
  return true;
}

void draw_exact_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas) {
  const int first = std::max(blob.first_row, canvas.first_row);
  const int last = std::min(blob.last_row, canvas.first_row + canvas.rows - 1);
  if (first > last) return;
  const ExactCap cap(blob, projection);
  const CapPlace place{blob.x,          blob.y, angle_of(blob), blob.reach, blob.first_column,
                       blob.last_column};
  for (int row = first; row <= last; ++row) {
    const CapSpans spans = spans_of(projection, place, row, canvas.columns[row - canvas.first_row]);
    for (std::size_t k = 0; k < spans.count; ++k)
      cap.add(row, spans.span[k].first, spans.span[k].last, canvas.at(row, spans.span[k].first));
  }
}

}  // namespace domefall
