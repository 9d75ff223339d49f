// How the image of a star is drawn: as a blob in angle, whose light does not depend on how large it is.
#pragma once

#include <vector>

#include "pipeline/render/blobs/ellipse_blob.h"
#include "pipeline/render/scene/point_spread.h"

namespace domefall {

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

}  // namespace domefall
