// Lines and outlines across the seam of a picture of the whole sphere.
#pragma once

#include "pipeline/render/overlay/coverage.h"

namespace domefall {

// Moves points by whole widths of the picture, so that each lies beside the one before it, on this
// or that side of the seam.  Does nothing on a picture without a seam.
void unwind(const Projection& projection, std::vector<PicturePoint>& points);

// By how much points that were unwound, and of which the last lies beside the first on the sphere,
// come back beside where they began: 0, or a width to either side if they go around a pole.
double winding(const Projection& projection, const std::vector<PicturePoint>& points);

// Calls use(shift) for each number of pixels by which what was unwound must be moved to the right,
// so that together all of it is in the picture: 0 alone on a picture without a seam.
template <class Use>
void each_copy(const Projection& projection, const Use& use) {
  use(0.0);
  if (!std::holds_alternative<Equirectangular>(projection)) return;
  use(-1.0 * columns(projection));
  use(1.0 * columns(projection));
}

// Adds a polygon of points that were placed one by one.  One around a pole is all that lies between
// its line and the edge of the picture there.
void add_unwound(PicturePolygon polygon, const Projection& projection, Coverage& coverage);

}  // namespace domefall
