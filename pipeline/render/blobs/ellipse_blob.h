// Ellipse blobs are the blobs of nearly all stars.  They are a few pixels wide and drawn as
// ellipses in pixels, to the first order of the projection.
#pragma once

#include <cstddef>

#include "pipeline/render/blobs/canvas.h"
#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/scene/star_image.h"

namespace domefall {

// An EllipseBlob is a blob with the weight W of BlobShape.
struct EllipseBlob {
  float x, y;        // as StarImage's
  float xx, xy, yy;  // P of BlobShape
  float rgb[3];      // peak values
};
static_assert(sizeof(EllipseBlob) == 32);

// These are the most pixels that an ellipse blob, or a wide one, covers along each axis.
inline constexpr int kMostEllipsePixels = 32, kMostWideEllipsePixels = 256;

// An image lies outside the frame, or it is drawn in one of two ways.
enum class BlobKind : unsigned char { kNowhere, kEllipse, kCap };

// Places `count` images, each of width sigma[k] (radians), as ellipse blobs.  kind[k] says what
// becomes of images[k].  Only where it is kEllipse are blobs[k] and first_row[k] meaningful.  The
// latter is the first row that the blob covers, and may be negative.  An image becomes a cap where
// an ellipse would be too large or too inaccurate, and where its peak is brighter than `most_peak`.
void place_ellipses(const Projection& projection, const StarImage* images, const double* sigma,
                    std::size_t count, double most_peak, EllipseBlob* blobs, int* first_row,
                    BlobKind* kind);

// Makes an ellipse of a placed cap.  It may be larger than those of place_ellipses(), as nearly all
// parts of halos are.  The function returns false, and does not change the ellipse, where the
// ellipse would be too large or brighter than `most_peak`.  It also returns false where the error
// exceeds both 1.2e-3 of the peak and a pixel value of 5e-4, which is a quarter of the smallest
// step that an 8-bit image has in the dark.
bool place_wide_ellipse(const Projection& projection, const CapBlob& cap, double most_peak,
                        EllipseBlob& ellipse);

// Adds the part of each blob that lies on the canvas.  The blobs are drawn in their order.
void draw_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas);
// Does the same at a cost that suits wide ellipses: it visits only those of their columns that they
// cover on the canvas.
void draw_wide_ellipses(const EllipseBlob* blobs, std::size_t count, const Canvas& canvas);

}  // namespace domefall
