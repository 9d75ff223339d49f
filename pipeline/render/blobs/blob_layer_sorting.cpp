// These functions of BlobLayer sort the placed blobs into bands of rows.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <tuple>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/blobs/merged_caps.h"

namespace domefall {

void BlobLayer::sort_splats() {
  first_splat_.assign(static_cast<std::size_t>(splat_buckets_->count()) + 1, 0);
  for (std::size_t t = 0; t < used_; ++t)
    // Summing each task's first[k] gives the number of splats of all tasks in the buckets before k.
    for (std::size_t k = 0; k < tasks_[t].splats.first.size(); ++k)
      first_splat_[k] += tasks_[t].splats.first[k];
}

// Sorts by counting: first the ellipses of each band and task are counted, then the sums of these
// counts say where each task writes.  Within a band the ellipses follow the order of the tasks.
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
  // The counts in `next` become places: next[t][band] says where task t writes its next ellipse.
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

// Caps of one band become neighbours in memory.  Caps compare as equal only if they have the same
// place, width and light, so the order does not depend on the tasks.
void BlobLayer::sort_caps() {
  for (const Task& task : tasks_) caps_.insert(caps_.end(), task.caps.begin(), task.caps.end());
  merge_crowds(projection_, caps_);
  const auto key = [](const CapBlob& b) {
    return std::tuple(b.first_row / kBandRows, b.y, b.x, b.sigma, b.rgb[0], b.rgb[1], b.rgb[2]);
  };
  std::ranges::sort(caps_, [&key](const CapBlob& a, const CapBlob& b) { return key(a) < key(b); });
  part_wide_ellipses();
}

// Replaces caps by wide ellipses where these are accurate enough, and lists both kinds by band.
void BlobLayer::part_wide_ellipses() {
  caps_of_band_.assign(bands_, {});
  wide_of_band_.assign(bands_, {});
  wide_.clear();
  std::size_t kept = 0;
  for (const CapBlob& cap : caps_) {
    EllipseBlob ellipse;
    const bool wide = place_wide_ellipse(projection_, cap, most_coloured_peak(cap.paling), ellipse);
    auto& of_band = wide ? wide_of_band_ : caps_of_band_;
    const auto number = static_cast<std::uint32_t>(wide ? wide_.size() : kept);
    for (int band = cap.first_row / kBandRows; band <= cap.last_row / kBandRows; ++band)
      of_band[static_cast<std::size_t>(band)].push_back(number);
    if (wide)
      wide_.push_back(ellipse);
    else
      caps_[kept++] = cap;
  }
  caps_.resize(kept);
}

void BlobLayer::sort_into_bands() {
  for (std::size_t t = 0; t < used_; ++t) size_ += tasks_[t].size;
  if (splat_buckets_) sort_splats();
  sort_ellipses();
  sort_caps();
}

}  // namespace domefall
