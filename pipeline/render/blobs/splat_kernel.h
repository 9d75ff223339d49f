// Splats: faint stars by the hundred thousand, drawn as blobs of one width.  Each star is dropped
// onto the pixels about it as a cubic B-spline, and afterwards all rows are blurred at once by what
// a blob is wider than the spline.  A splat costs a fraction of an ellipse, and the blur the same
// for any number.
//
// The spline's variance is 1/3 pixel^2 along each axis wherever its middle lies, and its values add
// up to 1 to rounding, so that no star's light depends on where it lies.  The blur is the same
// everywhere.  What a dome's outskirts stretch blobs along the tangent, or a flat image's in all
// directions, is added before: a star is dropped at a few points, which have a Gaussian's moments.
// The blur's fourth moment gives the whole that of a Gaussian over the square of a pixel, which
// ellipse blobs are.  Measured against those, in parts of the peak: 0.05 at a width of 0.9 pixel,
// where the spline's own shape shows, 0.02 at 1.14 (4k) and 0.01 at 2; 0.04 at the rim of a dome of
// 1024 pixels.  The brightest pixel of a drifting star swings by 1.33 instead of 1.32 at 0.9 pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render/blobs/canvas.h"
#include "pipeline/render/blobs/splat_loops.h"
#include "pipeline/render/scene/star_image.h"
#include "projections/projection.h"

namespace domefall {

// The splats of one task by bucket.  A bucket holds those whose middles lie on the kBandRows rows
// of a band; there are also buckets above and below the image.  Bucket k is images[first[k]] up to
// images[first[k + 1]].
struct SplatList {
  std::vector<StarImage> images;
  std::vector<std::uint32_t> first;
};

// How the splats of a frame are sorted, dropped and blurred.
class SplatKernel {
 public:
  // sigma: width of the blobs, radians.
  SplatKernel(const Projection& projection, double sigma);
  // False where the blur would need more taps than there is room for (blobs wider than 14 pixels)
  // or would be too narrow, and where the image is too small.
  bool usable() const { return usable_; }

  // Moves the images that can be splats to `splats`, in their order within each bucket, and the
  // others to the front of `images`.  most_light bounds the brightest channel of a splat.  Returns
  // the number of the others.
  std::size_t sort(std::vector<StarImage>& images, float most_light, SplatList& splats) const;

  int buckets() const { return buckets_; }
  // The first bucket whose splats can reach rows from first_row on, and the last one whose splats
  // can reach rows up to last_row.
  int first_bucket(int first_row) const;
  int last_bucket(int last_row) const;

 private:
  friend class SplatBuffer;

  bool takes(const StarImage& image, float most_light) const;

  SplatFrame frame_;
  bool dome_;
  int width_, height_;
  int reach_ = 0;       // rows and columns that a splat can touch on either side of its middle
  int margin_ = 0;      // columns of a buffer on either side of the image
  int taps_ = 0;        // of the blur, on either side
  int buckets_ = 0;     // all of them
  int lead_ = 0;        // buckets above the image
  float farthest_ = 0;  // squared distance of a splat from the image's middle, pixels^2
  float tap_[kMostSplatTaps + 1] = {};
  bool usable_ = false;
};

}  // namespace domefall
