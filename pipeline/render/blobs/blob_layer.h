// A BlobLayer holds the blobs of all stars of a frame, sorted into bands of rows, so that several
// threads can draw them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/blobs/splat_buffer.h"
#include "pipeline/render/scene/point_spread.h"

namespace domefall {

// A layer places each image as a splat, an ellipse or a cap.  A band is drawn in the order splats,
// ellipses, wide ellipses (which were made of caps), caps.  Splats and ellipses are sorted by the
// band in which they begin, and blobs of one kind follow the order of the tasks that placed them.
// The sums are therefore the same for any number of threads.  The sorting is in
// blob_layer_sorting.cpp.
class BlobLayer {
 public:
  explicit BlobLayer(const Projection& projection) { start(projection); }
  // Empties the layer for another frame.  It keeps its memory, because allocating memory costs as
  // much as the work that is done in it.
  void start(const Projection& projection);
  // Makes the layer draw faint images as splats from now on, if splats can have this width in this
  // projection.
  void use_splats(const PointSpread& widths);
  // Says whether a frame has so many images that splats are quicker than ellipses.
  static bool are_many(double images, const Projection& projection);
  bool has_splats() const { return splat_buckets_.has_value(); }

  // Adds `count` tasks and returns the first one's number.
  std::size_t new_tasks(std::size_t count);
  // Places the images of task `number`.  It is called once for each task, by any thread.
  // Afterwards the contents of `images` are unspecified.
  void place(std::size_t number, std::vector<StarImage>& images, const PointSpread& widths);

  // Adds images, or caps that are placed already, as tasks of the layer's own.
  void add(const std::vector<StarImage>& images, const PointSpread& widths);
  void add(const std::vector<CapBlob>& caps);
  // Ends the placing.  Bands can be drawn after this call.
  void sort_into_bands();

  // Returns the number of images that are at least partly in the frame.  Splats that just miss the
  // frame are counted too.
  std::size_t size() const { return size_; }

  // Prepares a thread's buffer for drawing bands of this layer, in rising order.
  void start_buffer(SplatBuffer& buffer) const {
    if (splat_buckets_) buffer.start(*splat_buckets_);
  }
  // Says whether anything may reach into a band.
  bool reaches(int band) const;
  // Adds the blobs' light on the rows of a band to rgb[rows][3 * columns].  The buffer belongs to
  // one thread.  Consecutive bands cost less when the same buffer draws them.
  void draw_band(int band, SplatBuffer& buffer, float* rgb) const;

 private:
  // A Task holds the blobs that one task has placed.
  struct Task {
    SplatList splats;
    std::vector<EllipseBlob> ellipses;
    std::vector<std::uint16_t> band;  // the band in which ellipses[k] begins
    std::vector<int> last_band;       // by band: the last band that ellipses beginning there reach
    std::vector<CapBlob> caps;
    std::size_t size = 0;

    void clear();
  };
  struct Parts;
  void place_blobs(const StarImage* images, std::size_t count, const PointSpread& widths,
                   Task& task) const;
  void place_parts(const Parts& parts, const PointSpread& widths, Task& task) const;
  bool place_one_cap(const StarImage& image, double sigma, float paling, Task& task) const;
  void place_one_ellipse(const EllipseBlob& ellipse, int first_row, Task& task) const;
  void place_with_copies(const EllipseBlob& ellipse, int first_row, Task& task) const;
  void sort_splats();
  void sort_ellipses();
  void sort_caps();
  void part_wide_ellipses();
  std::span<const EllipseBlob> ellipses_of(int band) const;
  void draw_splats(int band, SplatBuffer& buffer, float* rgb) const;
  void draw_wide(const std::vector<std::uint32_t>& numbers, const Canvas& canvas) const;

  Projection projection_;
  std::size_t bands_ = 0;
  std::vector<Task> tasks_;  // the first `used_` belong to this frame
  std::size_t used_ = 0, size_ = 0;

  std::optional<SplatBuckets> splat_buckets_;
  std::vector<std::size_t> first_splat_;  // by bucket: splats of all tasks in earlier buckets

  std::unique_ptr<EllipseBlob[]> ellipses_;  // sorted by the band in which they begin
  std::size_t ellipse_capacity_ = 0;
  std::vector<std::size_t> first_ellipse_;  // by band, then the end
  std::vector<int> last_band_;              // by band, over all tasks; see Task::last_band

  // Caps become wide ellipses where such an ellipse is accurate enough.  The lists hold, for each
  // band, the numbers of those that reach into it.
  std::vector<CapBlob> caps_;
  std::vector<EllipseBlob> wide_;
  std::vector<std::vector<std::uint32_t>> caps_of_band_, wide_of_band_;
};

}  // namespace domefall
