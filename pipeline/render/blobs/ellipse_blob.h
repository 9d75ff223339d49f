// The blobs of nearly all stars: a few pixels wide, drawn as ellipses in pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/render/blobs/blob_shape.h"
#include "pipeline/render/scene/star_image.h"

namespace domefall {

struct EllipseBlob {
  float x, y;        // as StarImage's
  float xx, xy, yy;  // BlobShape's P
  float rgb[3];      // peak values
};
static_assert(sizeof(EllipseBlob) == 32);

// Pixels along each axis that a small blob covers at most.
inline constexpr int kMostEllipsePixels = 32;

// Places images as small blobs.  kind[k] says what became of images[k], whose blob is blobs[k].
enum class Placed : unsigned char { kNowhere, kEllipse, kCap };

// Of count images, each with its sigma (radians).  Brighter peaks than `most_peak` are for wide blobs.
// first_row: the first that a small blob covers, which may lie above the picture.
void place_ellipses(const Projection& projection, const StarImage* images, const double* sigma,
                    std::size_t count, double most_peak, EllipseBlob* blobs, int* first_row,
                    Placed* kind);

// The columns that may be drawn on, one range per row.
struct Canvas {
  float* rgb;  // rows of 3 * width floats
  int width;
  int first_row, rows;  // at most kMostCanvasRows
  const ColumnRange* columns;

  float* at(int row, int column) const {
    return rgb + 3 * (static_cast<std::ptrdiff_t>(row - first_row) * width + column);
  }
};
inline constexpr int kMostCanvasRows = 8;

// Adds the part of each blob that lies on the canvas, in their order.
void draw_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas);

}  // namespace domefall
