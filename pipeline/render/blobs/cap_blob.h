// Cap blobs: blobs of any size, round in angle on the sphere, whose light does not depend on how
// large they are.
#pragma once

#include <cmath>

#include "pipeline/render/blobs/canvas.h"

namespace domefall {

// The weight is W = exp(-c^2/(2 sigma^2)), c the chord to the centre, over the square of each pixel
// and cut as blob_shape.h says.  Its sum over an image without edges, each pixel times its solid
// angle, is rgb to 1e-3 wherever the centre lies, which the tests show.
struct CapBlob {
  float x, y;    // as StarImage's
  float sigma;   // radians
  float rgb[3];  // as StarImage's
  // Where this times the blob's luminance (as a pixel value) passes 1, its colour is half way to
  // white; its luminance stays.  0 stands for a blob that keeps its colour.
  float paling;

  // What place_cap() sets: the disc that the blob covers, with its rows and columns in the frame,
  // and its BlobScale.
  float reach = 0;  // pixels
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  float peak_per_flux = 0, cut = 0;
};

// The brightest peak of a blob that ellipses and splats may stand for, which keep their colour
// everywhere.  It is an eighth of the value at which a cap is half white: there the middle has lost
// 1/65 of its colour.
inline double most_coloured_peak(float paling) { return paling > 0 ? 0.125 / paling : HUGE_VAL; }

// Sets what the blob covers.  Returns false if that is nothing, or if the blob would reach the
// point that a flat image has at infinity.
bool place_cap(const Projection& projection, CapBlob& blob);

// Adds the part of a placed blob that lies on the canvas.
void draw_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas);

}  // namespace domefall
