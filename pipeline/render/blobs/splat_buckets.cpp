#include "pipeline/render/blobs/splat_buckets.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/vector_math.h"

namespace domefall {
namespace {

// These are the variances along an axis, pixel^2, of a cubic B-spline and of the square of a pixel.
constexpr double kSplineVariance = 1.0 / 3, kPixelVariance = 1.0 / 12;
// These are their fourth cumulants.  The box of a pixel has -1/120.  The spline is four boxes
// convolved, and cumulants add up.
constexpr double kSplineFourth = -4.0 / 120, kPixelFourth = -1.0 / 120;
// The blur ends this many sigmas from its middle, where its Gaussian has fallen to e^-10.
constexpr double kTapSigmas = 4.5;
// A blur of a smaller variance (pixel^2) is too narrow to be sampled.
constexpr double kLeastVariance = 0.4;

// On a flat image a splat's variance may exceed that in the middle by this part of it.
constexpr double kMostMissing = 0.45;
// On a dome a splat may lie this far from the middle (radians).  The series in draw_splats.cpp
// hold up to 1.9.
constexpr double kFarthestAngle = 1.85;

// Samples a Gaussian of this variance and gives it the fourth cumulant `fourth`.  The sum of
// taps[|k|] over all k is 1.  The function returns the number of taps on either side.  It sets none
// if that exceeds `most`.
//
// Adding the fourth difference of a sequence, whose weights are 1, -4, 6, -4, 1, adds 2 (2^4 - 4) =
// 24 to its fourth moment and leaves the lower moments alone.
int find_taps(double variance, double fourth, int most, float* taps) {
  const int last = static_cast<int>(std::ceil(kTapSigmas * std::sqrt(variance)));
  if (last > most) return last;
  std::vector<double> even(static_cast<std::size_t>(2 * last + 5), 0.0);
  const auto middle = static_cast<std::size_t>(last + 2);
  double sum = 0;
  for (int k = -last; k <= last; ++k)
    sum += even[middle + static_cast<std::size_t>(k)] = exponential(-0.5 * k * k / variance);
  const double c = fourth / 24;
  double corrected = 0;
  std::vector<double> tap;
  for (int k = 0; k <= last; ++k) {
    const auto at = [&](int n) { return even[middle + static_cast<std::size_t>(std::abs(n))]; };
    tap.push_back(
        (at(k) + c * (at(k - 2) - 4 * at(k - 1) + 6 * at(k) - 4 * at(k + 1) + at(k + 2))) / sum);
    corrected += (k == 0 ? 1 : 2) * tap.back();
  }
  for (int k = 0; k <= last; ++k)
    taps[k] = static_cast<float>(tap[static_cast<std::size_t>(k)] / corrected);
  return last;
}

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

SplatBuckets::SplatBuckets(const Projection& projection, double sigma)
    : dome_(is_domemaster(projection)), width_(columns(projection)), height_(rows(projection)) {
  const double pixel = largest_pixel_angle(projection), unit = dome_ ? pixel : pixel / 2;
  const double variance = sigma * sigma / (pixel * pixel),
               wanted = variance + kPixelVariance - kSplineVariance;
  frame_ = {static_cast<float>((width_ - 1) / 2.0), static_cast<float>((height_ - 1) / 2.0),
            static_cast<float>(unit * unit), static_cast<float>(variance),
            static_cast<float>(1 / (pixel * pixel))};
  if (!(wanted > kLeastVariance)) return;
  taps_ = find_taps(wanted, kPixelFourth - kSplineFourth, kMostSplatTaps, tap_);
  if (taps_ > kMostSplatTaps) return;
  // On a dome the farthest splat lies a blob beyond the rim.  On a flat image the variance grows
  // like (1 + t)^2, and the farthest splat lies where it exceeds that in the middle by
  // kMostMissing.
  const double beyond = taps_ + 8;
  const double t = dome_ ? unit * unit * (width_ / 2.0 + beyond) * (width_ / 2.0 + beyond)
                         : std::sqrt(1 + kMostMissing) - 1;
  if (dome_ && t > kFarthestAngle * kFarthestAngle) return;
  const double theta = std::sqrt(t), sinc = sin_cos(theta).sine / theta;
  // This is the variance that the points have to supply at the farthest place, as in
  // find_missing() of draw_splats.cpp.
  const double missing = variance * (dome_ ? 1 / (sinc * sinc) - 1 : t * (2 + t));
  reach_ = static_cast<int>(std::ceil(double{kFarthestPoint} * std::sqrt(missing))) + 3;
  farthest_ = static_cast<float>(t / (unit * unit));
  margin_ = 2 * (taps_ + reach_) + kSplatFloatsBeyond / kSplatChannels;
  lead_ = (taps_ + reach_) / kBandRows + 1;
  count_ = (height_ + kBandRows - 1) / kBandRows + 2 * lead_;
  usable_ = true;
}

// Says whether an image can be a splat.  An image that cannot may still lie out of sight, which
// will be found when it is placed.
bool SplatBuckets::takes(const StarImage& image, float most_light) const {
  const float cx = image.x - frame_.middle_x, cy = image.y - frame_.middle_y;
  const auto beyond = static_cast<float>(taps_ + reach_);
  const float across = std::abs(cx), down = std::abs(cy);
  const bool near = (across < frame_.middle_x + beyond) & (down < frame_.middle_y + beyond);
  const bool faint = (image.rgb[0] <= most_light) & (image.rgb[1] <= most_light) &
                     (image.rgb[2] <= most_light);  // false for a NaN
  return near & (cx * cx + cy * cy < farthest_) & faint;
}

// Sorts by counting.
std::size_t SplatBuckets::sort(std::vector<StarImage>& images, float most_light,
                               SplatList& splats) const {
  splats.first.assign(static_cast<std::size_t>(count_) + 1, 0);
  const auto bucket_of = [this](const StarImage& image) {
    return static_cast<std::size_t>(
        static_cast<int>(image.y + static_cast<float>(lead_ * kBandRows)) / kBandRows);
  };
  // Each thread keeps its own list, since asking the system for memory would take longer than the
  // sort.
  thread_local std::vector<std::uint16_t> bucket;
  bucket.resize(images.size());
  constexpr std::uint16_t kNone = 0xffff;
  for (std::size_t k = 0; k < images.size(); ++k) {
    const bool taken = takes(images[k], most_light);
    bucket[k] = taken ? static_cast<std::uint16_t>(bucket_of(images[k])) : kNone;
    if (taken) ++splats.first[bucket[k]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : splats.first) {
    const std::uint32_t count = first;
    first = sum;
    sum += count;
  }
  splats.images.resize(sum);
  std::size_t others = 0;
  for (std::size_t k = 0; k < images.size(); ++k)
    if (bucket[k] == kNone)
      images[others++] = images[k];
    else
      splats.images[splats.first[bucket[k]]++] = images[k];
  // By now the start of each bucket has moved to that of the next bucket.
  for (std::size_t k = splats.first.size() - 1; k > 0; --k) splats.first[k] = splats.first[k - 1];
  splats.first[0] = 0;
  return others;
}

int SplatBuckets::first_bucket(int first_row) const {
  return std::max(0, lead_ + floor_div(first_row - taps_ - reach_, kBandRows));
}

int SplatBuckets::last_bucket(int last_row) const {
  return std::min(count_ - 1, lead_ + floor_div(last_row + taps_ + reach_, kBandRows));
}

}  // namespace domefall
