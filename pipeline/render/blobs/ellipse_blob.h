// Ellipse blobs: the blobs of nearly all stars, a few pixels wide and drawn as ellipses in pixels,
// to the first order of the projection.
#pragma once

#include <cstddef>

#include "pipeline/render/blobs/canvas.h"
#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/scene/star_image.h"

namespace domefall {

struct EllipseBlob {
  float x, y;        // as StarImage's
  float xx, xy, yy;  // P of BlobShape
  float rgb[3];      // peak values
};
static_assert(sizeof(EllipseBlob) == 32);

// The most pixels that an ellipse blob covers along each axis, and a wide one.
inline constexpr int kMostEllipsePixels = 32, kMostWideEllipsePixels = 256;

// What becomes of an image: nothing of it lies in the frame, or it is drawn in one of two ways.
enum class BlobKind : unsigned char { kNowhere, kEllipse, kCap };

// Places `count` images, each of width sigma[k] (radians), as ellipse blobs.  kind[k] tells what
// becomes of images[k], and only where it is kEllipse do blobs[k] and first_row[k] have a meaning:
// the latter is the first row that the blob covers, which may be negative.  An image becomes a cap
// where an ellipse would be too large or too inaccurate, and where its peak is brighter than
// `most_peak`.
void place_ellipses(const Projection& projection, const StarImage* images, const double* sigma,
                    std::size_t count, double most_peak, EllipseBlob* blobs, int* first_row,
                    BlobKind* kind);

// Makes an ellipse of a placed cap that is larger than the others, as nearly all parts of halos
// are.  Returns false, and leaves the ellipse as it is, where it would be too large, brighter than
// `most_peak`, or in error by more than 1.2e-3 of its peak and by more than a pixel value of 5e-4,
// which is a quarter of the least step that an image of 8 bits has in the dark.
bool place_wide_ellipse(const Projection& projection, const CapBlob& cap, double most_peak,
                        EllipseBlob& ellipse);

// Adds the part of each blob that lies on the canvas, in their order.
void draw_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas);
// The same, at the cost that suits wide ellipses: of their columns it looks only at those that they
// cover on the canvas.
void draw_wide_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas);

}  // namespace domefall
