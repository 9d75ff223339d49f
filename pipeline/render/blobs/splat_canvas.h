// Faint stars by the hundred thousand, as blobs of one width: each is dropped onto the pixels about it
// as a cubic B-spline, and rows are blurred, all at once, by what the blob is wider.
//
// The spline's variance is 1/3 pixel^2 along each axis wherever its middle lies, and its values sum up to
// 1 to rounding: no light depends on where a star is.  What a dome's outskirts stretch along the tangent, or
// a flat picture's in all directions, is added before: a star is dropped at a few points with a Gaussian's
// moments.  The blur is even, and its fourth moment such that the whole has that of a Gaussian over
// the square of a pixel, as small blobs do.  Measured against those, in parts of the peak: 0.05 at
// a width of 0.9 pixel, where the spline's own shape is seen, 0.02 at 1.14 (4k), 0.01 at 2; at the rim of
// a dome of 1024 pixels 0.04.  The brightest pixel swings by 1.33 instead of 1.32 at 0.9 pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render/blobs/splat_loops.h"
#include "pipeline/render/scene/star_image.h"
#include "projections/projection.h"

namespace domefall {

// Rows in which a bucket's dots have their middles.
inline constexpr int kBucketRows = 8;

// The dots of one task, by bucket: first[k] to first[k + 1] are those of bucket k.
struct SplatList {
  std::vector<StarImage> images;
  std::vector<std::uint32_t> first;
};

// How a picture's dots are dropped and blurred.
class SplatBrush {
 public:
  // sigma: of the blobs, radians.
  SplatBrush(const Projection& projection, double sigma);
  // False where a blur would need more taps than there is room for (blobs wider than 14 pixels), and where a
  // picture is too small.
  bool usable() const { return usable_; }

  // Moves the images that it takes on to `dots`, in their order within each bucket, and the others to the
  // front.  most_light: of the brightest channel.  Returns how many others there are.
  std::size_t sort(std::vector<StarImage>& images, float most_light, SplatList& dots) const;

  int buckets() const { return buckets_; }
  // The first and last bucket of which something reaches the rows first to last of the picture.
  int first_bucket(int first_row) const;
  int last_bucket(int last_row) const;

 private:
  friend class SplatCanvas;

  bool takes(const StarImage& image, float most_light) const;

  SplatFrame frame_;
  bool dome_;
  int width_, height_, reach_ = 0;         // rows and columns that a dot may touch on either side
  int margin_ = 0;                         // and with the blur
  int taps_ = 0, buckets_ = 0, lead_ = 0;  // lead_: buckets above the picture
  float tap_[kMostSplatTaps + 1] = {};
  float farthest_ = 0;  // of a dot from the middle, pixels^2
  bool usable_ = false;
};

// A thread's rows of dots, of a few bands that follow one another.
class SplatCanvas {
 public:
  // Forgets what was drawn.  The brush must outlive the bands.
  void start(const SplatBrush& brush);
  // Before the dots of a band of up to kBucketRows rows, which begins where a bucket does.
  void advance(int first_row);
  // The bucket to be dropped next, whose dots are these.
  int next_bucket() const { return next_bucket_; }
  struct Dots {
    const StarImage* first;
    std::size_t count;
  };
  void drop(const std::vector<Dots>& lists);
  // Adds the dots' part of `count` rows of the band to the pixels inside, rgb[count][3 * columns].
  void add_band(int first, int count, const ColumnRange* inside, float* rgb);

 private:
  float* row_at(int row);

  const SplatBrush* brush_ = nullptr;
  std::vector<float> memory_, blurred_;
  std::vector<float*> rows_;  // from table_first_ on
  std::vector<StarImage> sorted_;
  std::vector<std::size_t> next_of_tile_;
  std::ptrdiff_t stride_ = 0;
  int ring_ = 0, first_ = 0, table_first_ = 0, next_bucket_ = 0;
  bool fresh_ = true;
};

}  // namespace domefall
