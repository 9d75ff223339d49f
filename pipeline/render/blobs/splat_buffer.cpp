#include "pipeline/render/blobs/splat_buffer.h"

#include <algorithm>
#include <array>

namespace domefall {

void SplatBuffer::start(const SplatBuckets& buckets) {
  buckets_ = &buckets;
  fresh_ = true;
  stride_ = kSplatChannels * (buckets.width_ + 2 * buckets.margin_) + kSplatFloatsBeyond;
  // The ring holds the rows that a band's blur reads and those of the last bucket that touches
  // these.  One more row receives what splats drop on rows that no band needs any longer.
  ring_ = 2 * kBandRows + 2 * (buckets.taps_ + buckets.reach_);
  memory_.resize(static_cast<std::size_t>(stride_ * (ring_ + 1)));
  blurred_.resize(static_cast<std::size_t>((kBandRows + 1) * stride_));
}

float* SplatBuffer::row_at(int row) {
  // The remainder of a negative row is made positive.
  const int at = ((row % ring_) + ring_) % ring_;
  return memory_.data() + stride_ * at + kSplatChannels * buckets_->margin_;
}

void SplatBuffer::advance(int first_row) {
  const int first = first_row - buckets_->taps_;
  if (fresh_) {
    std::fill(memory_.begin(), memory_.end(), 0.0f);
    next_bucket_ = buckets_->first_bucket(first_row);
    first_ = first;
    fresh_ = false;
  }
  // Rows above the band are not needed any more.  They become empty rows below it.
  for (; first_ < first; ++first_)
    std::fill_n(row_at(first_) - kSplatChannels * buckets_->margin_, stride_, 0.0f);
  // Splats may fall on up to this many rows above the first row of the ring.  All these rows are
  // the one unused row.
  const int above = 2 * buckets_->reach_ + 2 * kBandRows;
  table_first_ = first_ - above;
  rows_.resize(static_cast<std::size_t>(above + ring_));
  float* unused = memory_.data() + stride_ * ring_ + kSplatChannels * buckets_->margin_;
  for (int k = 0; k < above + ring_; ++k)
    rows_[static_cast<std::size_t>(k)] = k < above ? unused : row_at(table_first_ + k);
}

// Drops splats tile by tile, so that the pixels on which they fall are in the cache.  The tiles are
// sorted by counting.
void SplatBuffer::drop(const std::vector<Splats>& lists) {
  constexpr int kColumns = 32;
  const auto offset = static_cast<float>(buckets_->margin_);
  const auto tile_of = [offset](const StarImage& image) {
    return static_cast<std::size_t>(image.x + offset) / kColumns;
  };
  next_of_tile_.assign(
      static_cast<std::size_t>(buckets_->width_ + 2 * buckets_->margin_) / kColumns + 2, 0);
  for (const Splats& splats : lists)
    for (std::size_t k = 0; k < splats.count; ++k) ++next_of_tile_[tile_of(splats.first[k]) + 1];
  for (std::size_t k = 1; k < next_of_tile_.size(); ++k) next_of_tile_[k] += next_of_tile_[k - 1];
  sorted_.resize(next_of_tile_.back());
  for (const Splats& splats : lists)
    for (std::size_t k = 0; k < splats.count; ++k)
      sorted_[next_of_tile_[tile_of(splats.first[k])]++] = splats.first[k];
  const SplatRows rows{rows_.data(), table_first_};
  drop_splats(buckets_->dome_, buckets_->frame_, sorted_.data(), sorted_.size(), rows);
  ++next_bucket_;
}

void SplatBuffer::add_band(int first, int count, const ColumnRange* inside, float* rgb) {
  int left = buckets_->width_, right = -1;
  for (int k = 0; k < count; ++k)
    if (inside[k].first <= inside[k].last) {
      left = std::min(left, inside[k].first);
      right = std::max(right, inside[k].last);
    }
  if (left > right) return;
  const int taps = buckets_->taps_;
  std::array<const float*, 2 * kMostSplatTaps + kBandRows> rows{};
  for (int n = 0; n < count + 2 * taps; ++n)
    rows[static_cast<std::size_t>(n)] = row_at(first - taps + n) + kSplatChannels * (left - taps);
  // All rows are blurred downwards from the first to the last column of the whole band, and `taps`
  // more on both sides, which the second blur reads.
  blur_down({buckets_->tap_, taps}, rows.data(), count,
            kSplatChannels * (right - left + 1 + 2 * taps), blurred_.data(), stride_);
  float* between = blurred_.data() + kBandRows * stride_;
  for (int k = 0; k < count; ++k) {
    const ColumnRange in = inside[k];
    if (in.first > in.last) continue;
    blur_along({buckets_->tap_, taps},
               blurred_.data() + k * stride_ + kSplatChannels * (in.first - left + taps),
               in.last - in.first + 1, between,
               rgb + 3 * (static_cast<std::ptrdiff_t>(k) * buckets_->width_ + in.first));
  }
}

}  // namespace domefall
