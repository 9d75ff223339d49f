// All stars of a frame, in bands of rows, ready to be drawn by several threads.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render/star_blobs.h"

namespace domefall {

// Rows that one task shades, covers with stars and stores, while they are still in its cache.
inline constexpr int kBandRows = 8;

class StarLayer {
 public:
  explicit StarLayer(const Projection& projection) : projection_(projection) {}

  // In the order in which they are to be drawn.
  void add(const std::vector<StarImage>& images, const BlobWidths& widths);
  void add(const std::vector<std::vector<StarImage>>& lists, const BlobWidths& widths);
  void add(const std::vector<StarBlob>& blobs);
  // Once all are there.
  void sort_into_bands();

  std::size_t size() const { return blobs_.size(); }

  // Adds what lies on the rows of a band to rgb[rows][3 * columns], row by row.
  void draw_band(int band, float* rgb) const;

 private:
  Projection projection_;
  std::vector<StarBlob> blobs_;
  std::vector<std::vector<std::uint32_t>> by_band_;
};

}  // namespace domefall
