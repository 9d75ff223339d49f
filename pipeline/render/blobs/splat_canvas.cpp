#include "pipeline/render/blobs/splat_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

// Variances, pixel^2: of a cubic B-spline, and of a pixel's square.
constexpr double kSpline = 1.0 / 3, kPixel = 1.0 / 12;
// Fourth cumulants of both: -1/120 for each square that a box is convolved from.
constexpr double kSplineFourth = -4.0 / 120, kPixelFourth = -1.0 / 120;
// The blur ends where it has fallen to e^-10.
constexpr double kTapSigmas = 4.5;

// On a flat picture what is missing may be so much of the blob's variance in the middle.
constexpr double kMostMissing = 0.45;

// A sampled Gaussian whose fourth cumulant is `fourth`: sum over k of f(k) = 1.  Returns how many.
int find_taps(double variance, double fourth, int most, float* taps) {
  const int last = static_cast<int>(std::ceil(kTapSigmas * std::sqrt(variance)));
  if (last > most) return last;
  std::vector<double> even(static_cast<std::size_t>(2 * last + 5), 0.0);
  const auto middle = static_cast<std::size_t>(last + 2);
  double sum = 0;
  for (int k = -last; k <= last; ++k)
    sum += even[middle + static_cast<std::size_t>(k)] = exponential(-0.5 * k * k / variance);
  // The fourth difference has a fourth moment of 24 and no lower one.
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

SplatBrush::SplatBrush(const Projection& projection, double sigma)
    : dome_(std::holds_alternative<Domemaster>(projection)),
      width_(columns(projection)),
      height_(rows(projection)) {
  const double pixel = central_pixel_angle(projection), unit = dome_ ? pixel : pixel / 2;
  const double variance = sigma * sigma / (pixel * pixel), wanted = variance + kPixel - kSpline;
  frame_ = {static_cast<float>((width_ - 1) / 2.0), static_cast<float>((height_ - 1) / 2.0),
            static_cast<float>(unit * unit), static_cast<float>(variance),
            static_cast<float>(1 / (pixel * pixel))};
  // As far off the middle as dots are taken: beyond a dome's rim by a blob, or where a flat picture's
  // pixels are so much smaller.
  constexpr double kLeastVariance = 0.4;
  if (!(wanted > kLeastVariance)) return;
  taps_ = find_taps(wanted, kPixelFourth - kSplineFourth, kMostSplatTaps, tap_);
  if (taps_ > kMostSplatTaps) return;
  const double beyond = taps_ + 8;
  const double t = dome_ ? unit * unit * (width_ / 2.0 + beyond) * (width_ / 2.0 + beyond)
                         : std::sqrt(1 + kMostMissing) - 1;
  constexpr double kFarthestAngle = 1.85;
  if (dome_ && t > kFarthestAngle * kFarthestAngle) return;
  const double theta = std::sqrt(t), sinc = sin_cos(theta).sine / theta;
  const double missing = variance * (dome_ ? 1 / (sinc * sinc) - 1 : t * (2 + t));
  reach_ = static_cast<int>(std::ceil(double{kFarthestPoint} * std::sqrt(missing))) + 3;
  farthest_ = static_cast<float>(t / (unit * unit));
  margin_ = 2 * (taps_ + reach_) + kSplatFloatsBeyond / kSplatChannels;
  lead_ = (taps_ + reach_) / kBucketRows + 1;
  buckets_ = (height_ + kBucketRows - 1) / kBucketRows + 2 * lead_;
  usable_ = true;
}

// Of what is not taken, what no blob brings into the picture is found out elsewhere.
bool SplatBrush::takes(const StarImage& image, float most_light) const {
  const float cx = image.x - frame_.middle_x, cy = image.y - frame_.middle_y;
  const auto beyond = static_cast<float>(taps_ + reach_);
  const float across = std::abs(cx), down = std::abs(cy);
  const bool near = (across < frame_.middle_x + beyond) & (down < frame_.middle_y + beyond);
  const bool faint = (image.rgb[0] <= most_light) & (image.rgb[1] <= most_light) &
                     (image.rgb[2] <= most_light);  // and a number
  return near & (cx * cx + cy * cy < farthest_) & faint;
}

std::size_t SplatBrush::sort(std::vector<StarImage>& images, float most_light,
                             SplatList& dots) const {
  dots.first.assign(static_cast<std::size_t>(buckets_) + 1, 0);
  const auto bucket_of = [this](const StarImage& image) {
    return static_cast<std::size_t>(
        static_cast<int>(image.y + static_cast<float>(lead_ * kBucketRows)) / kBucketRows);
  };
  // A thread's own, kept: asking the system for memory would take longer than all the rest.
  thread_local std::vector<std::uint16_t> bucket;
  bucket.resize(images.size());
  constexpr std::uint16_t kNone = 0xffff;
  for (std::size_t k = 0; k < images.size(); ++k) {
    const bool taken = takes(images[k], most_light);
    bucket[k] = taken ? static_cast<std::uint16_t>(bucket_of(images[k])) : kNone;
    if (taken) ++dots.first[bucket[k]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : dots.first) {
    const std::uint32_t count = first;
    first = sum;
    sum += count;
  }
  dots.images.resize(sum);
  std::size_t others = 0;
  for (std::size_t k = 0; k < images.size(); ++k)
    if (bucket[k] == kNone)
      images[others++] = images[k];
    else
      dots.images[dots.first[bucket[k]]++] = images[k];
  // Each bucket's first has become the next one's.
  for (std::size_t k = dots.first.size() - 1; k > 0; --k) dots.first[k] = dots.first[k - 1];
  dots.first[0] = 0;
  return others;
}

int SplatBrush::first_bucket(int first_row) const {
  return std::max(0, lead_ + floor_div(first_row - taps_ - reach_, kBucketRows));
}

int SplatBrush::last_bucket(int last_row) const {
  return std::min(buckets_ - 1, lead_ + floor_div(last_row + taps_ + reach_, kBucketRows));
}

void SplatCanvas::start(const SplatBrush& brush) {
  brush_ = &brush, fresh_ = true;
  stride_ = kSplatChannels * (brush.width_ + 2 * brush.margin_) + kSplatFloatsBeyond;
  // The rows that a band's blur takes in, and those of the last bucket that touches them; and one for
  // what is nobody's.
  ring_ = 2 * kBucketRows + 2 * (brush.taps_ + brush.reach_);
  memory_.resize(static_cast<std::size_t>(stride_ * (ring_ + 1)));
  blurred_.resize(static_cast<std::size_t>((kBucketRows + 1) * stride_));
}

float* SplatCanvas::row_at(int row) {
  const int at = ((row % ring_) + ring_) % ring_;
  return memory_.data() + stride_ * at + kSplatChannels * brush_->margin_;
}

void SplatCanvas::advance(int first_row) {
  const int first = first_row - brush_->taps_;
  if (fresh_) {
    std::fill(memory_.begin(), memory_.end(), 0.0f);
    next_bucket_ = brush_->first_bucket(first_row);
    first_ = first;
    fresh_ = false;
  }
  for (; first_ < first; ++first_)
    std::fill_n(row_at(first_) - kSplatChannels * brush_->margin_, stride_, 0.0f);
  const int above = 2 * brush_->reach_ + 2 * kBucketRows;
  table_first_ = first_ - above;
  rows_.resize(static_cast<std::size_t>(above + ring_));
  float* nobodys = memory_.data() + stride_ * ring_ + kSplatChannels * brush_->margin_;
  for (int k = 0; k < above + ring_; ++k)
    rows_[static_cast<std::size_t>(k)] = k < above ? nobodys : row_at(table_first_ + k);
}

// Neighbours one after another: what they are dropped on is in the cache.
void SplatCanvas::drop(const std::vector<Dots>& lists) {
  constexpr int kColumns = 32;
  const auto offset = static_cast<float>(brush_->margin_);
  const auto tile_of = [offset](const StarImage& image) {
    return static_cast<std::size_t>(image.x + offset) / kColumns;
  };
  next_of_tile_.assign(
      static_cast<std::size_t>(brush_->width_ + 2 * brush_->margin_) / kColumns + 2, 0);
  for (const Dots& dots : lists)
    for (std::size_t k = 0; k < dots.count; ++k) ++next_of_tile_[tile_of(dots.first[k]) + 1];
  for (std::size_t k = 1; k < next_of_tile_.size(); ++k) next_of_tile_[k] += next_of_tile_[k - 1];
  sorted_.resize(next_of_tile_.back());
  for (const Dots& dots : lists)
    for (std::size_t k = 0; k < dots.count; ++k)
      sorted_[next_of_tile_[tile_of(dots.first[k])]++] = dots.first[k];
  const SplatRows rows{rows_.data(), table_first_};
  drop_splats(brush_->dome_, brush_->frame_, sorted_.data(), sorted_.size(), rows);
  ++next_bucket_;
}

void SplatCanvas::add_band(int first, int count, const ColumnRange* inside, float* rgb) {
  int left = brush_->width_, right = -1;
  for (int k = 0; k < count; ++k)
    if (inside[k].first <= inside[k].last)
      left = std::min(left, inside[k].first), right = std::max(right, inside[k].last);
  if (left > right) return;
  const int taps = brush_->taps_;
  std::array<const float*, 2 * kMostSplatTaps + kBucketRows> rows{};
  for (int n = 0; n < count + 2 * taps; ++n)
    rows[static_cast<std::size_t>(n)] = row_at(first - taps + n) + kSplatChannels * (left - taps);
  blur_down({brush_->tap_, taps}, rows.data(), count,
            kSplatChannels * (right - left + 1 + 2 * taps), blurred_.data(), stride_);
  float* between = blurred_.data() + kBucketRows * stride_;
  for (int k = 0; k < count; ++k) {
    const ColumnRange in = inside[k];
    if (in.first > in.last) continue;
    blur_along({brush_->tap_, taps},
               blurred_.data() + k * stride_ + kSplatChannels * (in.first - left + taps),
               in.last - in.first + 1, between,
               rgb + 3 * (static_cast<std::ptrdiff_t>(k) * brush_->width_ + in.first));
  }
}

}  // namespace domefall
