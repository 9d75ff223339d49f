// The blobs of all stars of a frame, sorted into bands of rows, so that several threads can draw
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/blobs/splat_buffer.h"
#include "pipeline/render/scene/point_spread.h"

namespace domefall {

// Places images as splats, ellipses and caps, and draws these in that order, with wide ellipses
// before the caps of which they were made.  Splats and ellipses are drawn by the band in which they
// begin, and blobs of a kind in the order of the tasks that placed them, so that the sums are the
// same for any number of threads.  Sorting is blob_layer_sorting.cpp.
class BlobLayer {
 public:
  explicit BlobLayer(const Projection& projection) { start(projection); }
  // Empties the layer for another frame.  Its memory is kept, because new memory costs as much as
  // what is done in it.
  void start(const Projection& projection);
  // From now on draws faint images as splats, if the blobs are of a width at which that is
  // possible.
  void use_splats(const PointSpread& widths);
  // Whether a frame has so many images that splats are quicker than ellipses.
  static bool are_many(double images, const Projection& projection);
  bool has_splats() const { return kernel_.has_value(); }

  // Adds `count` tasks and returns the first one's number.
  std::size_t new_tasks(std::size_t count);
  // Places the images of task `number`, once, in whatever thread.  It leaves no meaningful images
  // in the list.
  void place(std::size_t number, std::vector<StarImage>& images, const PointSpread& widths);

  // Adds images, or caps that are placed already, as tasks of its own.
  void add(const std::vector<StarImage>& images, const PointSpread& widths);
  void add(const std::vector<CapBlob>& caps);
  // Ends the placing.  Bands can be drawn afterwards.
  void sort_into_bands();

  // The number of images of which something is in the frame.  Splats that just miss it are counted
  // too.
  std::size_t size() const { return size_; }

  // Prepares a thread's buffer for drawing bands of this layer, in rising order.
  void start_buffer(SplatBuffer& buffer) const {
    if (kernel_) buffer.start(*kernel_);
  }
  // Adds the blobs' light on the rows of a band to rgb[rows][3 * columns].  The buffer belongs to
  // one thread; bands that follow one another in it cost less.
  void draw_band(int band, SplatBuffer& buffer, float* rgb) const;

 private:
  // What one task places.
  struct Task {
    SplatList splats;
    std::vector<EllipseBlob> ellipses;
    std::vector<std::uint16_t> band;  // in which ellipses[k] begins
    std::vector<int> last_band;       // by band: the last one that ellipses beginning there reach
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
  void draw_splats(int band, SplatBuffer& buffer, float* rgb) const;
  void draw_wide(const std::vector<std::uint32_t>& numbers, const Canvas& canvas) const;

  Projection projection_;
  std::size_t bands_ = 0;
  std::vector<Task> tasks_;  // of which `used_` are this frame's
  std::size_t used_ = 0, size_ = 0;

  std::optional<SplatKernel> kernel_;
  std::vector<std::size_t>
      first_splat_;  // by bucket: the splats of all tasks in the buckets before

  std::unique_ptr<EllipseBlob[]> ellipses_;  // by the band in which they begin
  std::size_t ellipse_capacity_ = 0;
  std::vector<std::size_t> first_ellipse_;  // by band, and the end
  std::vector<int> last_band_;              // by band, as a task's

  // Caps become wide ellipses where these are accurate enough.
  std::vector<CapBlob> caps_;
  std::vector<EllipseBlob> wide_;
  std::vector<std::vector<std::uint32_t>> caps_of_band_, wide_of_band_;  // that reach into it
};

}  // namespace domefall
