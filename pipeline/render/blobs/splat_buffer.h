// A SplatBuffer holds the rows of pixels on which one thread accumulates splats, bucket by bucket
// (splat_buckets.h), before they are blurred (draw_splats.h).
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/render/blobs/splat_buckets.h"

namespace domefall {

// The rows form a ring, large enough for the splats of a few bands.  Successive bands share rows,
// so that each splat is dropped once for all of them.
class SplatBuffer {
 public:
  // Forgets what was dropped before.  The buckets must outlive the drawing of the bands.
  void start(const SplatBuckets& buckets);
  // Makes room for the splats of the band that begins at first_row, a multiple of kBandRows.
  void advance(int first_row);
  // Returns the bucket that drop() takes next.
  int next_bucket() const { return next_bucket_; }
  struct Splats {
    const StarImage* first;
    std::size_t count;
  };
  // Drops the splats of the next bucket, which come in several lists.
  void drop(const std::vector<Splats>& lists);
  // Blurs the splats of `count` rows from `first` on, and adds them to the pixels of
  // rgb[count][3 * width] that the image covers, by row in `inside`.
  void add_band(int first, int count, const ColumnRange* inside, float* rgb);

 private:
  float* row_at(int row);

  const SplatBuckets* buckets_ = nullptr;
  std::vector<float> memory_;   // `ring_` rows, and one more that is never read
  std::vector<float> blurred_;  // the rows of a band, blurred downwards, and one more
  std::vector<float*> rows_;    // pointers to the first pixel of each row from table_first_ on
  std::vector<StarImage> sorted_;
  std::vector<std::size_t> next_of_tile_;
  std::ptrdiff_t stride_ = 0;  // floats of a row
  int ring_ = 0, first_ = 0, table_first_ = 0, next_bucket_ = 0;
  bool fresh_ = true;
};

}  // namespace domefall
