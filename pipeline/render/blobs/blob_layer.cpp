#include "pipeline/render/blobs/blob_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "pipeline/render/blobs/merged_caps.h"

namespace domefall {
namespace {

// The images that one task places, whatever the number of threads, and those that it places at
// once.
constexpr std::size_t kTask = 32768, kStep = 256;

// A blob whose peak is this part of the value at which stars are half white is drawn as a cap,
// which can turn white: at such a peak its middle has lost 1/65 of its colour.
constexpr double kPalingSeen = 1.0 / 8;

// Splats are quicker where a frame has more than one image for so many pixels: measured at 4k.
constexpr double kPixelsPerSplat = 32;
// The brightest peak of a splat, where blobs are at their smallest.  A brighter one would visibly
// end.
constexpr double kBrightestSplat = 1;

double most_coloured(const PointSpread& widths) {
  return widths.paling() > 0 ? kPalingSeen / widths.paling() : HUGE_VAL;
}

float brightest_splat(const PointSpread& widths) {
  const double peak = std::min(kBrightestSplat, most_coloured(widths));
  return static_cast<float>(std::min(
      widths.single_blob_light(), peak * 2 * std::numbers::pi * widths.least() * widths.least()));
}

// The most bands that an ellipse touches.
constexpr int kMostBands = (kMostEllipsePixels + 2 * kBandRows - 2) / kBandRows;

// The columns of each row of a band that the image covers.
std::array<ColumnRange, kBandRows> columns_inside(const Projection& projection, int first,
                                                  int count) {
  std::array<ColumnRange, kBandRows> inside;
  for (int k = 0; k < count; ++k)
    inside[static_cast<std::size_t>(k)] = inside_columns(projection, first + k);
  return inside;
}

}  // namespace

void BlobLayer::Task::clear() {
  ellipses.clear();
  band.clear();
  last_band.clear();
  caps.clear();
  splats.images.clear();
  splats.first.clear();
  size = 0;
}

void BlobLayer::start(const Projection& projection) {
  projection_ = projection;
  bands_ = static_cast<std::size_t>((rows(projection) + kBandRows - 1) / kBandRows);
  kernel_.reset();
  for (Task& task : tasks_) task.clear();
  used_ = size_ = 0;
  caps_.clear();
}

bool BlobLayer::are_many(double images, const Projection& projection) {
  return images * kPixelsPerSplat > static_cast<double>(columns(projection)) * rows(projection);
}

void BlobLayer::use_splats(const PointSpread& widths) {
  kernel_.emplace(projection_, widths.least());
  if (!kernel_->usable()) kernel_.reset();
}

// ---- placing ----

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
  if (kernel_) {
    others = kernel_->sort(images, brightest_splat(widths), task.splats);
    task.size += task.splats.images.size();
  }
  place_blobs(images.data(), others, widths, task);
}

// Places this share of an image's light as a cap; false if the frame has nothing of it.
bool BlobLayer::place_one_cap(const StarImage& image, double sigma, double share, float paling,
                              Task& task) const {
  const auto part = static_cast<float>(share);
  CapBlob cap{image.x,
              image.y,
              static_cast<float>(sigma),
              {image.rgb[0] * part, image.rgb[1] * part, image.rgb[2] * part},
              paling};
  const bool seen = place_cap(projection_, cap);
  if (seen) task.caps.push_back(cap);
  return seen;
}

void BlobLayer::place_one_ellipse(const EllipseBlob& ellipse, int first_row, Task& task) const {
  task.ellipses.push_back(ellipse);
  const int band = std::max(first_row, 0) / kBandRows;
  task.band.push_back(static_cast<std::uint16_t>(band));
  // The ellipse reaches as far below its middle as above; two more rows make up for rounding.
  const auto last_row = static_cast<int>(2 * ellipse.y) - first_row + 2;
  int& last = task.last_band[static_cast<std::size_t>(band)];
  last = std::max(last, last_row / kBandRows);
}

void BlobLayer::place_blobs(const StarImage* images, std::size_t count, const PointSpread& widths,
                            Task& task) const {
  const double most_peak = most_coloured(widths);
  std::array<StarImage, kStep> middle;
  std::array<double, kStep> sigma;
  std::array<EllipseBlob, kStep> ellipses;
  std::array<int, kStep> first_row;
  std::array<BlobKind, kStep> kind;
  task.ellipses.reserve(count);
  task.band.reserve(count);
  task.last_band.resize(bands_, 0);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t n = std::min(kStep, count - begin);
    for (std::size_t k = 0; k < n; ++k) {
      const StarImage& image = images[begin + k];
      middle[k] = image;
      sigma[k] = widths.least();
      if (std::max({image.rgb[0], image.rgb[1], image.rgb[2]}) <= widths.single_blob_light())
        continue;
      const PointSpreadParts parts = widths.parts(image);
      middle[k] = parts.image;
      sigma[k] = parts.sigma;
      for (const PointSpreadParts::Halo& halo : parts.halo)
        if (halo.share > 0) place_one_cap(image, halo.sigma, halo.share, widths.paling(), task);
    }
    place_ellipses(projection_, middle.data(), sigma.data(), n, most_peak, ellipses.data(),
                   first_row.data(), kind.data());
    for (std::size_t k = 0; k < n; ++k) {
      if (kind[k] == BlobKind::kNowhere) continue;
      if (kind[k] == BlobKind::kCap) {
        task.size += place_one_cap(middle[k], sigma[k], 1, widths.paling(), task);
        continue;
      }
      ++task.size;
      place_one_ellipse(ellipses[k], first_row[k], task);
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

void BlobLayer::add(const std::vector<CapBlob>& caps) {
  Task& task = tasks_[new_tasks(1)];
  task.caps = caps;
  task.size = caps.size();
}

// ---- sorting ----

void BlobLayer::sort_splats() {
  first_splat_.assign(static_cast<std::size_t>(kernel_->buckets()) + 1, 0);
  for (std::size_t t = 0; t < used_; ++t)
    for (std::size_t k = 0; k < tasks_[t].splats.first.size(); ++k)
      first_splat_[k] += tasks_[t].splats.first[k];
}

// A counting sort by band.  Within a band the tasks' ellipses follow one another in the tasks'
// order.
void BlobLayer::sort_ellipses() {
  std::vector<std::vector<std::size_t>> next(used_, std::vector<std::size_t>(bands_));
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    for (const std::uint16_t band : tasks_[t].band) ++next[t][band];
  });
  first_ellipse_.assign(bands_ + 1, 0);
  last_band_.assign(bands_, 0);
  for (const Task& task : tasks_)
    for (std::size_t band = 0; band < task.last_band.size(); ++band)
      last_band_[band] = std::max(last_band_[band], task.last_band[band]);
  std::size_t sum = 0;
  for (std::size_t band = 0; band < bands_; ++band) {
    first_ellipse_[band] = sum;
    for (auto& of_task : next) {
      const std::size_t count = of_task[band];
      of_task[band] = sum;
      sum += count;
    }
  }
  first_ellipse_[bands_] = sum;
  if (ellipse_capacity_ < sum) {
    ellipses_ = std::make_unique_for_overwrite<EllipseBlob[]>(sum);
    ellipse_capacity_ = sum;
  }
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    const Task& task = tasks_[t];
    for (std::size_t k = 0; k < task.ellipses.size(); ++k)
      ellipses_[next[t][task.band[k]]++] = task.ellipses[k];
  });
}

// The caps of a band lie side by side in memory.  Only caps of one place and light compare as
// equal, so that the order does not depend on the tasks.
void BlobLayer::sort_caps() {
  for (const Task& task : tasks_) caps_.insert(caps_.end(), task.caps.begin(), task.caps.end());
  merge_crowds(projection_, caps_);
  const auto key = [](const CapBlob& b) {
    return std::tuple(b.first_row / kBandRows, b.y, b.x, b.sigma, b.rgb[0], b.rgb[1], b.rgb[2]);
  };
  std::sort(caps_.begin(), caps_.end(),
            [&key](const CapBlob& a, const CapBlob& b) { return key(a) < key(b); });
  caps_of_band_.assign(bands_, {});
  for (std::size_t k = 0; k < caps_.size(); ++k)
    for (int band = caps_[k].first_row / kBandRows; band <= caps_[k].last_row / kBandRows; ++band)
      caps_of_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
}

void BlobLayer::sort_into_bands() {
  for (std::size_t t = 0; t < used_; ++t) size_ += tasks_[t].size;
  if (kernel_) sort_splats();
  sort_ellipses();
  sort_caps();
}

// ---- drawing ----

void BlobLayer::draw_splats(int band, SplatBuffer& buffer, float* rgb) const {
  const int first = band * kBandRows, count = std::min(kBandRows, rows(projection_) - first);
  const int end_bucket = kernel_->last_bucket(first + count - 1) + 1;
  const auto before = [this](int bucket) { return first_splat_[static_cast<std::size_t>(bucket)]; };
  if (before(kernel_->first_bucket(first)) == before(end_bucket)) {
    buffer.start(*kernel_);
    return;
  }
  buffer.advance(first);
  std::vector<SplatBuffer::Splats> lists;
  while (buffer.next_bucket() < end_bucket) {
    const auto bucket = static_cast<std::size_t>(buffer.next_bucket());
    lists.clear();
    for (std::size_t t = 0; t < used_; ++t) {
      const SplatList& splats = tasks_[t].splats;
      if (!splats.images.empty())
        lists.push_back({splats.images.data() + splats.first[bucket],
                         splats.first[bucket + 1] - splats.first[bucket]});
    }
    buffer.drop(lists);
  }
  buffer.add_band(first, count, columns_inside(projection_, first, count).data(), rgb);
}

// rgb is drawn on by way of the canvas.  NOLINTNEXTLINE(readability-non-const-parameter)
void BlobLayer::draw_band(int band, SplatBuffer& buffer, float* rgb) const {
  if (kernel_) draw_splats(band, buffer, rgb);
  const int first = band * kBandRows, count = std::min(kBandRows, rows(projection_) - first);
  const auto inside = columns_inside(projection_, first, count);
  const Canvas canvas{rgb, columns(projection_), first, count, inside.data()};
  const auto own = static_cast<std::size_t>(band);
  auto begin = static_cast<std::size_t>(std::max(0, band - kMostBands + 1));
  while (begin < own && last_band_[begin] < band) ++begin;
  const std::size_t from = first_ellipse_[begin], end = first_ellipse_[own + 1];
  draw_ellipses(ellipses_.get() + from, end - from, canvas);
  for (const std::uint32_t k : caps_of_band_[own]) draw_cap(caps_[k], projection_, canvas);
}

}  // namespace domefall
