// How the image of a star is drawn: as a blob in angle, whose light does not depend on how large it is.
#pragma once

#include "pipeline/render/star_image.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// A truncated Gaussian in angle about a direction: weight exp(-q) - exp(-q_max), q = c^2/(2 sigma^2),
// c the chord to the centre, out to kBlobReach sigma; zero and continuous at its end.
struct StarBlob {
  CameraDirection centre;
  double sigma;  // radians
  float rgb[3];  // as StarImage's
  float norm;    // 1 / (integral of the weight over the sphere)
  int first_row, last_row, first_column, last_column;  // pixels from 0, clipped to the image
};

inline constexpr double kBlobReach = 4.5;

// The peak of a narrower blob would change by a third or more as it drifts across pixels: stars
// would twinkle.
inline constexpr double kLeastSigmaPixels = 0.9;

// The widths of a frame's blobs, by the brightness of their stars.
class BlobWidths {
 public:
  // exposure_scale: pixel value of 1 cd/m^2.
  BlobWidths(const StarBlobs& law, const Projection& projection, double exposure_scale);
  double least() const { return least_; }  // sigma, radians; at least 0.9 pixel
  double most() const { return most_; }
  double of(const StarImage& image) const;

 private:
  StarBlobs law_;
  double scale_, least_, most_;
};

// Fills norm and the pixels that a blob of given centre and sigma covers; false if none is in the
// picture.  Its weights' sum is that of a blob in the open: a star at the rim is cut, not dimmed.
bool place_blob(const Projection& projection, StarBlob& blob);

// Adds the part of a blob that lies on row `row` (from 0) to rgb[3 * columns].
void draw_row(const StarBlob& blob, const Projection& projection, int row, float* rgb);

}  // namespace domefall
