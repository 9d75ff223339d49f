// All stars of a frame, in bands of rows, ready to be drawn by several threads.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/render/star_blobs.h"

namespace domefall {

// Rows that one task shades, covers with stars and stores, while they are still in its cache.
inline constexpr int kBandRows = 8;
static_assert(kBandRows <= kMostCanvasRows);

// The same sums for any number of threads: small blobs first, by the band in which they begin, then
// wide ones, each in the order in which they came.
class StarLayer {
 public:
  explicit StarLayer(const Projection& projection) { start(projection); }
  // An empty layer for another frame, in the memory of the one before: new memory costs as much as what
  // is done in it.
  void start(const Projection& projection);

  void add(const std::vector<StarImage>& images, const BlobWidths& widths);
  void add(const std::vector<std::vector<StarImage>>& lists, const BlobWidths& widths);
  void add(const std::vector<StarBlob>& blobs);
  // Once all are there.
  void sort_into_bands();

  // Images of which something is in the picture.
  std::size_t size() const { return size_; }

  // Adds what lies on the rows of a band to rgb[rows][3 * columns], row by row.
  void draw_band(int band, float* rgb) const;

 private:
  // What one task places.
  struct Batch {
    std::vector<SmallBlob> small;
    std::vector<std::uint16_t> band;  // in which small[k] begins
    std::vector<int> last_band;       // that blobs which begin in a band reach
    std::vector<StarBlob> wide;
    std::size_t size = 0;

    void clear();
  };
  // So many more, empty; the first one's number.
  std::size_t new_batches(std::size_t count);
  void place(const StarImage* images, std::size_t count, const BlobWidths& widths,
             Batch& batch) const;
  void sort_small();

  Projection projection_;
  std::size_t bands_ = 0;
  std::vector<Batch> batches_;  // of which `used_` are this frame's
  std::size_t used_ = 0, size_ = 0;
  std::unique_ptr<SmallBlob[]> small_;  // by band
  std::size_t small_capacity_ = 0;
  std::vector<std::size_t> first_small_;  // of each band, and the end
  std::vector<int> last_small_;           // the last band that those of a band reach
  std::vector<StarBlob> wide_;
  std::vector<std::vector<std::uint32_t>> wide_of_band_;
};

}  // namespace domefall
