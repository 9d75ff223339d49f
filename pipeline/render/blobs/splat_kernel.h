// Splats draw hundreds of thousands of faint stars as blobs of one width.  Each star is dropped
// onto the pixels around it as a cubic B-spline.  A blob is wider than the spline, so afterwards
// all rows are blurred at once by the difference.  A splat costs a fraction of an ellipse, and the
// blur costs the same for any number of splats.
//
// The spline has a variance of 1/3 pixel^2 along each axis wherever its middle lies, and its values
// add up to 1 except for rounding.  No star's light therefore depends on its position.  The blur is
// the same everywhere.  Towards the edge, however, blobs are stretched: on a dome along the
// tangent, on a flat image in all directions.  For this a star is dropped not at one point but at a
// few points, which have the moments of a Gaussian.  The fourth moment of the blur is chosen so
// that the whole has that of a Gaussian over the square of a pixel, which is what ellipse blobs
// are.
//
// The difference to ellipse blobs was measured in parts of the peak.  It is 0.05 at a width of 0.9
// pixel, where the shape of the spline shows, 0.02 at 1.14 (4k), 0.01 at 2, and 0.04 at the rim of
// a dome of 1024 pixels.  As a star of width 0.9 pixel drifts, its brightest pixel changes by a
// factor of 1.33, against 1.32 for ellipses.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render/blobs/canvas.h"
#include "pipeline/render/blobs/splat_loops.h"
#include "pipeline/render/scene/star_image.h"
#include "projections/projection.h"

namespace domefall {

// A SplatList holds the splats of one task, sorted by bucket.  A bucket holds those whose middles
// lie on the kBandRows rows of a band.  There are also buckets above and below the image.  Bucket k
// is images[first[k]] up to images[first[k + 1]].
struct SplatList {
  std::vector<StarImage> images;
  std::vector<std::uint32_t> first;
};

// A SplatKernel says how the splats of a frame are sorted, dropped and blurred.
class SplatKernel {
 public:
  // sigma is the width of the blobs in radians.
  SplatKernel(const Projection& projection, double sigma);
  // Returns false where the blur would be too narrow, or would need more taps than there is room
  // for (blobs wider than 14 pixels), and where the image is too small.
  bool usable() const { return usable_; }

  // Moves the images that can be splats to `splats`, in their order within each bucket, and the
  // others to the front of `images`.  Returns the number of the others.  The brightest channel of a
  // splat is at most most_light.
  std::size_t sort(std::vector<StarImage>& images, float most_light, SplatList& splats) const;

  int buckets() const { return buckets_; }
  // Return the first bucket whose splats can reach rows from first_row on, and the last bucket
  // whose splats can reach rows up to last_row.
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
  int taps_ = 0;        // taps of the blur on either side
  int buckets_ = 0;     // in all
  int lead_ = 0;        // buckets above the image
  float farthest_ = 0;  // squared distance of a splat from the image's middle, pixels^2
  float tap_[kMostSplatTaps + 1] = {};
  bool usable_ = false;
};

}  // namespace domefall
