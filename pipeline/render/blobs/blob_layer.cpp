#include "pipeline/render/blobs/blob_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "pipeline/render/blobs/cap_crowds.h"

namespace domefall {
namespace {

// Images that one task places; however many threads there are.
constexpr std::size_t kTask = 32768, kStep = 256;

// A blob brighter than this part of where stars turn white may show it: in its middle 1/65 of its colour.
constexpr double kPalingSeen = 1.0 / 8;

// A picture with more images than a 32nd of its pixels is quicker with dots: measured at 4k.
constexpr double kPixelsPerSplat = 32;
// The peak of a dot where the blob is at its smallest.  A brighter one would be seen to end.
constexpr double kBrightestSplat = 1;

double most_coloured(const PointSpread& widths) {
  return widths.paling() > 0 ? kPalingSeen / widths.paling() : HUGE_VAL;
}

float brightest_splat(const PointSpread& widths) {
  const double peak = std::min(kBrightestSplat, most_coloured(widths));
  return static_cast<float>(std::min(
      widths.single_blob_light(), peak * 2 * std::numbers::pi * widths.least() * widths.least()));
}

// Of bands, that a small blob may touch.
constexpr int kMostBands = (kMostEllipsePixels + 2 * kBandRows - 2) / kBandRows;

}  // namespace

void BlobLayer::Task::clear() {
  small.clear(), band.clear(), last_band.clear(), wide.clear();
  dots.images.clear(), dots.first.clear();
  size = 0;
}

void BlobLayer::start(const Projection& projection) {
  projection_ = projection;
  bands_ = static_cast<std::size_t>((rows(projection) + kBandRows - 1) / kBandRows);
  brush_.reset();
  for (Task& task : tasks_) task.clear();
  used_ = size_ = 0;
  wide_.clear();
}

bool BlobLayer::are_many(double images, const Projection& projection) {
  return images * kPixelsPerSplat > static_cast<double>(columns(projection)) * rows(projection);
}

void BlobLayer::use_splats(const PointSpread& widths) {
  brush_.emplace(projection_, widths.least());
  if (!brush_->usable()) brush_.reset();
}

std::size_t BlobLayer::new_tasks(std::size_t count) {
  const std::size_t before = used_;
  used_ += count;
  if (tasks_.size() < used_) tasks_.resize(used_);
  return before;
}

void BlobLayer::place(std::size_t number, std::vector<StarImage>& images,
                      const PointSpread& widths) {
  Task& task = tasks_[number];
  std::size_t others = images.size();
  if (brush_) {
    others = brush_->sort(images, brightest_splat(widths), task.dots);
    task.size += task.dots.images.size();
  }
  place_blobs(images.data(), others, widths, task);
}

void BlobLayer::place_blobs(const StarImage* images, std::size_t count, const PointSpread& widths,
                            Task& task) const {
  const double most_peak = most_coloured(widths);
  std::array<StarImage, kStep> middle;
  std::array<double, kStep> sigma;
  std::array<EllipseBlob, kStep> blobs;
  std::array<int, kStep> first_row;
  std::array<Placed, kStep> placed;
  const auto add_wide = [&](const StarImage& image, double width, double share) {
    const auto part = static_cast<float>(share);
    CapBlob blob{image.x,
                 image.y,
                 static_cast<float>(width),
                 {image.rgb[0] * part, image.rgb[1] * part, image.rgb[2] * part},
                 widths.paling()};
    const bool seen = place_cap(projection_, blob);
    if (seen) task.wide.push_back(blob);
    return seen;
  };
  task.small.reserve(count), task.band.reserve(count);
  task.last_band.resize(bands_, 0);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t n = std::min(kStep, count - begin);
    for (std::size_t k = 0; k < n; ++k) {
      const StarImage& image = images[begin + k];
      middle[k] = image, sigma[k] = widths.least();
      if (std::max({image.rgb[0], image.rgb[1], image.rgb[2]}) <= widths.single_blob_light())
        continue;
      const PointSpreadParts parts = widths.parts(image);
      middle[k] = parts.image, sigma[k] = parts.sigma;
      for (const PointSpreadParts::Halo& halo : parts.halo)
        if (halo.share > 0) add_wide(image, halo.sigma, halo.share);
    }
    place_ellipses(projection_, middle.data(), sigma.data(), n, most_peak, blobs.data(),
                   first_row.data(), placed.data());
    for (std::size_t k = 0; k < n; ++k) {
      if (placed[k] == Placed::kNowhere) continue;
      if (placed[k] == Placed::kCap) {
        task.size += add_wide(middle[k], sigma[k], 1);
        continue;
      }
      ++task.size;
      task.small.push_back(blobs[k]);
      const int band = std::max(first_row[k], 0) / kBandRows;
      task.band.push_back(static_cast<std::uint16_t>(band));
      // As far below the middle as above, and a row for rounding.
      const auto last_row = static_cast<int>(2 * blobs[k].y) - first_row[k] + 2;
      int& last = task.last_band[static_cast<std::size_t>(band)];
      last = std::max(last, last_row / kBandRows);
    }
  }
}

void BlobLayer::add(const std::vector<StarImage>& images, const PointSpread& widths) {
  const std::size_t count = (images.size() + kTask - 1) / kTask, before = new_tasks(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    const auto first = images.begin() + static_cast<std::ptrdiff_t>(t * kTask);
    const auto left = static_cast<std::size_t>(images.end() - first);
    std::vector<StarImage> own(first, first + static_cast<std::ptrdiff_t>(std::min(kTask, left)));
    place(before + t, own, widths);
  });
}

void BlobLayer::add(const std::vector<CapBlob>& blobs) {
  Task& task = tasks_[new_tasks(1)];
  task.wide = blobs, task.size = blobs.size();
}

// A counting sort by band that keeps the order within a band, each task's blobs in its own turn.
void BlobLayer::sort_small() {
  std::vector<std::vector<std::size_t>> next(used_, std::vector<std::size_t>(bands_));
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    for (const std::uint16_t band : tasks_[t].band) ++next[t][band];
  });
  first_small_.assign(bands_ + 1, 0), last_small_.assign(bands_, 0);
  for (const Task& task : tasks_)
    for (std::size_t band = 0; band < task.last_band.size(); ++band)
      last_small_[band] = std::max(last_small_[band], task.last_band[band]);
  std::size_t sum = 0;
  for (std::size_t band = 0; band < bands_; ++band) {
    first_small_[band] = sum;
    for (auto& of_task : next) {
      const std::size_t count = of_task[band];
      of_task[band] = sum;
      sum += count;
    }
  }
  first_small_[bands_] = sum;
  if (small_capacity_ < sum) {
    small_ = std::make_unique_for_overwrite<EllipseBlob[]>(sum);
    small_capacity_ = sum;
  }
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    const Task& task = tasks_[t];
    for (std::size_t k = 0; k < task.small.size(); ++k)
      small_[next[t][task.band[k]]++] = task.small[k];
  });
}

void BlobLayer::sort_into_bands() {
  sort_small();
  for (std::size_t t = 0; t < used_; ++t) size_ += tasks_[t].size;
  if (brush_) {
    first_splat_.assign(static_cast<std::size_t>(brush_->buckets()) + 1, 0);
    for (std::size_t t = 0; t < used_; ++t)
      for (std::size_t k = 0; k < tasks_[t].dots.first.size(); ++k)
        first_splat_[k] += tasks_[t].dots.first[k];
  }
  for (const Task& task : tasks_) wide_.insert(wide_.end(), task.wide.begin(), task.wide.end());
  merge_crowds(projection_, wide_);
  // Those of a band side by side in memory, in an order that only blobs of one place and light share.
  const auto key = [](const CapBlob& b) {
    return std::tuple(b.first_row / kBandRows, b.y, b.x, b.sigma, b.rgb[0], b.rgb[1], b.rgb[2]);
  };
  std::sort(wide_.begin(), wide_.end(),
            [&key](const CapBlob& a, const CapBlob& b) { return key(a) < key(b); });
  wide_of_band_.assign(bands_, {});
  for (std::size_t k = 0; k < wide_.size(); ++k)
    for (int band = wide_[k].first_row / kBandRows; band <= wide_[k].last_row / kBandRows; ++band)
      wide_of_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
}

void BlobLayer::draw_splats(int band, SplatCanvas& canvas, float* rgb) const {
  const int first = band * kBandRows, last = std::min(first + kBandRows, rows(projection_)) - 1;
  const int end_bucket = brush_->last_bucket(last) + 1;
  const auto number = [this](int bucket) { return first_splat_[static_cast<std::size_t>(bucket)]; };
  if (number(brush_->first_bucket(first)) == number(end_bucket)) {
    canvas.start(*brush_);
    return;
  }
  canvas.advance(first);
  std::vector<SplatCanvas::Dots> lists;
  while (canvas.next_bucket() < end_bucket) {
    const auto bucket = static_cast<std::size_t>(canvas.next_bucket());
    lists.clear();
    for (std::size_t t = 0; t < used_; ++t) {
      const SplatList& dots = tasks_[t].dots;
      if (!dots.images.empty())
        lists.push_back(
            {dots.images.data() + dots.first[bucket], dots.first[bucket + 1] - dots.first[bucket]});
    }
    canvas.drop(lists);
  }
  std::array<ColumnRange, kBandRows> inside;
  for (int row = first; row <= last; ++row)
    inside[static_cast<std::size_t>(row - first)] = inside_columns(projection_, row);
  canvas.add_band(first, last - first + 1, inside.data(), rgb);
}

// rgb is drawn on by way of the canvas.  NOLINTNEXTLINE(readability-non-const-parameter)
void BlobLayer::draw_band(int band, SplatCanvas& dots, float* rgb) const {
  if (brush_) draw_splats(band, dots, rgb);
  const int first = band * kBandRows, count = std::min(kBandRows, rows(projection_) - first);
  std::array<ColumnRange, kBandRows> inside;
  for (int k = 0; k < count; ++k)
    inside[static_cast<std::size_t>(k)] = inside_columns(projection_, first + k);
  const Canvas canvas{rgb, columns(projection_), first, count, inside.data()};
  const auto own = static_cast<std::size_t>(band);
  auto begin = static_cast<std::size_t>(std::max(0, band - kMostBands + 1));
  while (begin < own && last_small_[begin] < band) ++begin;
  const std::size_t from = first_small_[begin];
  const std::size_t end = first_small_[static_cast<std::size_t>(band) + 1];
  draw_ellipses(small_.get() + from, end - from, canvas);
  for (const std::uint32_t k : wide_of_band_[static_cast<std::size_t>(band)])
    draw_cap(wide_[k], projection_, canvas);
}

}  // namespace domefall
