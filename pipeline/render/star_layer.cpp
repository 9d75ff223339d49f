#include "pipeline/render/star_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "pipeline/render/blob_crowds.h"

namespace domefall {
namespace {

// Images that one task places; however many threads there are.
constexpr std::size_t kTask = 32768, kStep = 256;

// A blob brighter than this part of where stars turn white may show it: in its middle 1/65 of its colour.
constexpr double kPalingSeen = 1.0 / 8;

// Of bands, that a small blob may touch.
constexpr int kMostBands = (kSmallBlobPixels + 2 * kBandRows - 2) / kBandRows;

}  // namespace

void StarLayer::Batch::clear() {
  small.clear(), band.clear(), last_band.clear(), wide.clear();
  size = 0;
}

void StarLayer::start(const Projection& projection) {
  projection_ = projection;
  bands_ = static_cast<std::size_t>((rows(projection) + kBandRows - 1) / kBandRows);
  for (Batch& batch : batches_) batch.clear();
  used_ = size_ = 0;
  wide_.clear();
}

std::size_t StarLayer::new_batches(std::size_t count) {
  const std::size_t before = used_;
  used_ += count;
  if (batches_.size() < used_) batches_.resize(used_);
  return before;
}

void StarLayer::place(const StarImage* images, std::size_t count, const BlobWidths& widths,
                      Batch& batch) const {
  const double most_peak = widths.paling() > 0 ? kPalingSeen / widths.paling() : HUGE_VAL;
  std::array<StarImage, kStep> middle;
  std::array<double, kStep> sigma;
  std::array<SmallBlob, kStep> blobs;
  std::array<int, kStep> first_row;
  std::array<Placed, kStep> placed;
  const auto add_wide = [&](const StarImage& image, double width, double share) {
    const auto part = static_cast<float>(share);
    StarBlob blob{image.x,
                  image.y,
                  static_cast<float>(width),
                  {image.rgb[0] * part, image.rgb[1] * part, image.rgb[2] * part},
                  widths.paling(),
                  0,
                  0,
                  0,
                  0,
                  0};
    const bool seen = place_blob(projection_, blob);
    if (seen) batch.wide.push_back(blob);
    return seen;
  };
  batch.small.reserve(count), batch.band.reserve(count);
  batch.last_band.resize(bands_, 0);
  for (std::size_t begin = 0; begin < count; begin += kStep) {
    const std::size_t n = std::min(kStep, count - begin);
    for (std::size_t k = 0; k < n; ++k) {
      const StarImage& image = images[begin + k];
      middle[k] = image, sigma[k] = widths.least();
      if (std::max({image.rgb[0], image.rgb[1], image.rgb[2]}) <= widths.plain()) continue;
      const BlobParts parts = widths.parts(image);
      middle[k] = parts.image, sigma[k] = parts.sigma;
      for (const BlobParts::Halo& halo : parts.halo)
        if (halo.share > 0) add_wide(image, halo.sigma, halo.share);
    }
    place_small_blobs(projection_, middle.data(), sigma.data(), n, most_peak, blobs.data(),
                      first_row.data(), placed.data());
    for (std::size_t k = 0; k < n; ++k) {
      if (placed[k] == Placed::kNowhere) continue;
      if (placed[k] == Placed::kWide) {
        batch.size += add_wide(middle[k], sigma[k], 1);
        continue;
      }
      ++batch.size;
      batch.small.push_back(blobs[k]);
      const int band = std::max(first_row[k], 0) / kBandRows;
      batch.band.push_back(static_cast<std::uint16_t>(band));
      // As far below the middle as above, and a row for rounding.
      const auto last_row = static_cast<int>(2 * blobs[k].y) - first_row[k] + 2;
      int& last = batch.last_band[static_cast<std::size_t>(band)];
      last = std::max(last, last_row / kBandRows);
    }
  }
}

// Lists in a row that are one task's, until they hold enough.
void StarLayer::add(const std::vector<std::vector<StarImage>>& lists, const BlobWidths& widths) {
  std::vector<std::size_t> first{0};
  std::size_t images = 0;
  for (std::size_t k = 0; k < lists.size(); ++k) {
    images += lists[k].size();
    if (images < kTask) continue;
    first.push_back(k + 1);
    images = 0;
  }
  if (first.back() < lists.size()) first.push_back(lists.size());
  const std::size_t tasks = first.size() - 1, before = new_batches(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t t) {
    for (std::size_t k = first[t]; k < first[t + 1]; ++k)
      place(lists[k].data(), lists[k].size(), widths, batches_[before + t]);
  });
  for (std::size_t t = before; t < used_; ++t) size_ += batches_[t].size;
}

void StarLayer::add(const std::vector<StarImage>& images, const BlobWidths& widths) {
  const std::size_t tasks = (images.size() + kTask - 1) / kTask, before = new_batches(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t t) {
    const std::size_t first = t * kTask;
    place(images.data() + first, std::min(kTask, images.size() - first), widths,
          batches_[before + t]);
  });
  for (std::size_t t = before; t < used_; ++t) size_ += batches_[t].size;
}

void StarLayer::add(const std::vector<StarBlob>& blobs) {
  batches_[new_batches(1)].wide = blobs;
  size_ += blobs.size();
}

// A counting sort by band that keeps the order within a band, each task's blobs in its own turn.
void StarLayer::sort_small() {
  std::vector<std::vector<std::size_t>> next(used_, std::vector<std::size_t>(bands_));
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    for (const std::uint16_t band : batches_[t].band) ++next[t][band];
  });
  first_small_.assign(bands_ + 1, 0), last_small_.assign(bands_, 0);
  for (const Batch& batch : batches_)
    for (std::size_t band = 0; band < batch.last_band.size(); ++band)
      last_small_[band] = std::max(last_small_[band], batch.last_band[band]);
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
    small_ = std::make_unique_for_overwrite<SmallBlob[]>(sum);
    small_capacity_ = sum;
  }
  tbb::parallel_for(std::size_t{0}, used_, [&](std::size_t t) {
    const Batch& batch = batches_[t];
    for (std::size_t k = 0; k < batch.small.size(); ++k)
      small_[next[t][batch.band[k]]++] = batch.small[k];
  });
}

void StarLayer::sort_into_bands() {
  sort_small();
  for (const Batch& batch : batches_)
    wide_.insert(wide_.end(), batch.wide.begin(), batch.wide.end());
  merge_crowds(projection_, wide_);
  wide_of_band_.assign(bands_, {});
  for (std::size_t k = 0; k < wide_.size(); ++k)
    for (int band = wide_[k].first_row / kBandRows; band <= wide_[k].last_row / kBandRows; ++band)
      wide_of_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
}

// rgb is drawn on by way of the canvas.  NOLINTNEXTLINE(readability-non-const-parameter)
void StarLayer::draw_band(int band, float* rgb) const {
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
  draw_small_blobs(small_.get() + from, end - from, canvas);
  for (const std::uint32_t k : wide_of_band_[static_cast<std::size_t>(band)])
    draw_blob(wide_[k], projection_, canvas);
}

}  // namespace domefall
