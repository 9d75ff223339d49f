// SplatBuckets say which images of a frame can be splats (draw_splats.h), and sort those into
// buckets of rows.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/render/blobs/canvas.h"
#include "pipeline/render/blobs/draw_splats.h"
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

// How far a bucket's splats reach depends on the points at which they are dropped and on the taps
// of their blur.  So SplatBuckets find the taps, too, with which a SplatBuffer blurs.
class SplatBuckets {
 public:
  // sigma is the width of the blobs in radians.
  SplatBuckets(const Projection& projection, double sigma);
  // Returns false where the blur would be too narrow, or would need more taps than there is room
  // for (blobs wider than 14 pixels), and where the image is too small.
  bool usable() const { return usable_; }

  // Moves the images that can be splats to `splats`, in their order within each bucket, and the
  // others to the front of `images`.  Returns the number of the others.  The brightest channel of a
  // splat is at most most_light.
  std::size_t sort(std::vector<StarImage>& images, float most_light, SplatList& splats) const;

  int count() const { return count_; }
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
  int count_ = 0;       // buckets in all
  int lead_ = 0;        // buckets above the image
  float farthest_ = 0;  // squared distance of a splat from the image's middle, pixels^2
  float tap_[kMostSplatTaps + 1] = {};
  bool usable_ = false;
};

}  // namespace domefall
