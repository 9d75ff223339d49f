// Cap blobs are blobs of any size that are round in angle on the sphere.  Their light does not
// depend on their size.
#pragma once

#include <cmath>

#include "pipeline/render/blobs/canvas.h"

namespace domefall {

// The weight is W = exp(-c^2/(2 sigma^2)), where c is the chord to the centre.  It is averaged over
// the square of each pixel and cut as blob_shape.h says.  Over an image without edges, the sum of
// the pixels, each times its solid angle, is rgb to 1e-3 wherever the centre lies, as the tests
// show.
struct CapBlob {
  float x, y;    // as StarImage's
  float sigma;   // radians
  float rgb[3];  // as StarImage's
  // The colour is half way to white where the product of this and the blob's luminance (as a pixel
  // value) is 1.  The luminance stays the same.  A blob with 0 keeps its colour everywhere.
  float paling;

  // place_cap() sets these members: the disc that the blob covers, its rows and columns in the
  // frame, and its BlobScale.
  float reach = 0;  // pixels
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  float peak_per_flux = 0, cut = 0;
};

// Returns the brightest peak of a blob that ellipses and splats may replace.  Those keep their
// colour everywhere.  A cap loses the part x^2/(1 + x^2) of its colour, where x is its value over
// the one at which it is half white.  At x = 1/8, the limit, the middle has lost 1/65.
inline double most_coloured_peak(float paling) { return paling > 0 ? 0.125 / paling : HUGE_VAL; }

// Sets what the blob covers.  Returns false if it covers nothing, or if it would reach the point
// that a flat image has at infinity.
bool place_cap(const Projection& projection, CapBlob& blob);

// Adds the part of a placed blob that lies on the canvas.
void draw_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas);

}  // namespace domefall
