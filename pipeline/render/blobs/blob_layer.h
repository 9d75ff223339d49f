// All stars of a frame, in bands of rows, ready to be drawn by several threads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/blobs/splat_canvas.h"

namespace domefall {

// Rows that one task shades, covers with stars and stores, while they are still in its cache.
inline constexpr int kBandRows = 8;
static_assert(kBandRows <= kMostCanvasRows);

static_assert(kBandRows == kBucketRows);

// The same sums for any number of threads: dots first, then small blobs, both by the band in which they
// begin, then wide ones, each in the order of the tasks that found them.
class BlobLayer {
 public:
  explicit BlobLayer(const Projection& projection) { start(projection); }
  // An empty layer for another frame, in the memory of the one before: new memory costs as much as what
  // is done in it.
  void start(const Projection& projection);
  // From now on faint images are dots, which is worth it where there are many.
  void use_splats(const PointSpread& widths);
  static bool are_many(double images, const Projection& projection);
  bool has_splats() const { return brush_.has_value(); }

  // So many tasks more; the first one's number.
  std::size_t new_tasks(std::size_t count);
  // The images of task `number`, in whatever thread, once.  What is in the list afterwards is of no use.
  void place(std::size_t number, std::vector<StarImage>& images, const PointSpread& widths);

  void add(const std::vector<StarImage>& images, const PointSpread& widths);
  void add(const std::vector<CapBlob>& blobs);
  // Once all are there.
  void sort_into_bands();

  // Images of which something is in the picture, and dots next to it.
  std::size_t size() const { return size_; }

  // Before bands of this layer, in rising order, are drawn with a thread's canvas.
  void start_canvas(SplatCanvas& canvas) const {
    if (brush_) canvas.start(*brush_);
  }
  // Adds what lies on the rows of a band to rgb[rows][3 * columns], row by row.  The canvas is one thread's;
  // bands that follow one another cost less.
  void draw_band(int band, SplatCanvas& dots, float* rgb) const;

 private:
  // What one task places.
  struct Task {
    SplatList dots;
    std::vector<EllipseBlob> small;
    std::vector<std::uint16_t> band;  // in which small[k] begins
    std::vector<int> last_band;       // that blobs which begin in a band reach
    std::vector<CapBlob> wide;
    std::size_t size = 0;

    void clear();
  };
  void place_blobs(const StarImage* images, std::size_t count, const PointSpread& widths,
                   Task& task) const;
  void sort_small();
  void draw_splats(int band, SplatCanvas& canvas, float* rgb) const;

  Projection projection_;
  std::size_t bands_ = 0;
  std::optional<SplatBrush> brush_;
  std::vector<std::size_t> first_splat_;  // of each bucket among all
  std::vector<Task> tasks_;               // of which `used_` are this frame's
  std::size_t used_ = 0, size_ = 0;
  std::unique_ptr<EllipseBlob[]> small_;  // by band
  std::size_t small_capacity_ = 0;
  std::vector<std::size_t> first_small_;  // of each band, and the end
  std::vector<int> last_small_;           // the last band that those of a band reach
  std::vector<CapBlob> wide_;
  std::vector<std::vector<std::uint32_t>> wide_of_band_;
};

}  // namespace domefall
