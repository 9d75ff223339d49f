#include "pipeline/render/star_layer.h"

#include <algorithm>

namespace domefall {

void StarLayer::add(const std::vector<StarImage>& images, const BlobWidths& widths) {
  for (const StarImage& image : images) {
    StarBlob blob;
    blob.centre = direction_at(projection_, {image.x + 1.0, image.y + 1.0});
    blob.sigma = widths.of(image);
    std::copy_n(image.rgb, 3, blob.rgb);
    if (place_blob(projection_, blob)) blobs_.push_back(blob);
  }
}

void StarLayer::add(const std::vector<std::vector<StarImage>>& lists, const BlobWidths& widths) {
  for (const auto& images : lists) add(images, widths);
}

void StarLayer::add(const std::vector<StarBlob>& blobs) {
  blobs_.insert(blobs_.end(), blobs.begin(), blobs.end());
}

void StarLayer::sort_into_bands() {
  by_band_.assign(static_cast<std::size_t>((rows(projection_) + kBandRows - 1) / kBandRows), {});
  for (std::size_t k = 0; k < blobs_.size(); ++k)
    for (int band = blobs_[k].first_row / kBandRows; band <= blobs_[k].last_row / kBandRows; ++band)
      by_band_[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
}

void StarLayer::draw_band(int band, float* rgb) const {
  const int first = band * kBandRows, end = std::min(first + kBandRows, rows(projection_));
  const auto stride = static_cast<std::size_t>(columns(projection_)) * 3;
  for (const std::uint32_t k : by_band_[static_cast<std::size_t>(band)])
    for (int row = std::max(first, blobs_[k].first_row); row < end && row <= blobs_[k].last_row;
         ++row)
      draw_row(blobs_[k], projection_, row, rgb + static_cast<std::size_t>(row - first) * stride);
}

}  // namespace domefall
