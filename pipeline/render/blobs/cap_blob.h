// How the image of a star is drawn: as a blob in angle, whose light does not depend on how large it is.
#pragma once

#include <vector>

#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// The peak of a narrower blob would change by half as it drifts across pixels: stars would twinkle.
inline constexpr double kLeastSigmaPixels = 0.9;

// A blob of any size: W = exp(-c^2 / (2 sigma^2)), c the chord to the centre, over the square of each
// pixel and cut as blob_shape.h says.  Its sum over a picture without edges, each pixel times its solid
// angle, is rgb to 1e-3 wherever the centre lies.
struct CapBlob {
  float x, y;    // as StarImage's
  float sigma;   // radians
  float rgb[3];  // as StarImage's
  // Where this times the blob's luminance (as a pixel value) passes 1, its colour pales to white; its
  // luminance stays.  0: nowhere.
  float paling;
  // What it covers: a disc of this radius (pixels), and clipped to the picture.
  float reach = 0;
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  float peak_per_flux = 0, cut = 0;  // BlobScale
};

// Fills the last seven; false if there is nothing to cover.
bool place_cap(const Projection& projection, CapBlob& blob);

// Adds the part of a blob that lies on the canvas.
void draw_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas);

// A star as the blobs that its law makes of it.
struct PointSpreadParts {
  StarImage image;  // the middle, with what light the halo leaves it
  double sigma;     // radians
  struct Halo {
    double sigma, share;  // share: of the star's light; 0: unseen
  };
  std::array<Halo, 2> halo;
};

// The widths of a frame's blobs, by the brightness of their stars.
class PointSpread {
 public:
  // exposure_scale: pixel value of 1 cd/m^2.
  PointSpread(const PointSpreadLaw& law, const Projection& projection, double exposure_scale);
  double least() const { return least_; }  // sigma, radians; at least 0.9 pixel
  double most() const { return most_; }
  // No blob or halo reaches farther from its middle (radians).
  double reach() const;
  double of(const StarImage& image) const;
  PointSpreadParts parts(const StarImage& image) const;
  // An image whose brightest channel is no more than this is one blob of the least width.
  double plain() const { return plain_; }
  float paling() const { return paling_; }

 private:
  PointSpreadLaw law_;
  double least_, most_, reference_;  // reference_: luminance of rgb from which blobs grow
  double halo_sigma_, plain_;
  float paling_;
};

}  // namespace domefall
