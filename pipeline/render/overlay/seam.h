// An equirectangular image of the whole sphere has a seam, where its left side meets its right.
// These functions draw lines and outlines across it.
#pragma once

#include "pipeline/render/overlay/coverage.h"

namespace domefall {

// Moves points by whole widths of the image, so that each point lies beside the one before it,
// even if that is beyond the seam.  Does nothing on an image without a seam.
void unwind(const Projection& projection, std::vector<ImagePoint>& points);

// Returns how far from the first point the last one lies in the image, in whole widths.  The
// points were unwound, and the last is beside the first on the sphere.  The result is in pixels: 0,
// or a width to either side if the points go around a pole.
double winding(const Projection& projection, const std::vector<ImagePoint>& points);

// Calls use(shift) for each number of pixels by which unwound points must be moved to the right, so
// that the copies together show all of the line in the image.  On an image without a seam the
// shift is 0 alone.
template <class Use>
void each_copy(const Projection& projection, const Use& use) {
  use(0.0);
  if (!std::holds_alternative<Equirectangular>(projection)) return;
  use(-1.0 * columns(projection));
  use(1.0 * columns(projection));
}

// Adds a polygon of points that were placed one by one.  A polygon around a pole covers everything
// between its line and the edge of the image at that pole.
void add_unwound(ImagePolygon polygon, const Projection& projection, Coverage& coverage);

}  // namespace domefall
