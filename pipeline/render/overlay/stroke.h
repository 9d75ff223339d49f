// Lines are drawn as bands of even width.  An equirectangular image of the whole sphere has a seam,
// where its left side meets its right, and lines and outlines go on across it.
#pragma once

#include <functional>

#include "pipeline/light/lens.h"
#include "pipeline/render/overlay/coverage.h"
#include "projections/projection.h"

namespace domefall {

// Adds a band about a line through points, of a width on the screen in the unit of ScreenSides.  A
// closed line goes on from its last point to its first.  Where the line turns by a right angle or
// less, the band keeps its width at the corner.  Boxes and curves of many points need no more.
void add_stroke(const std::vector<ImagePoint>& line, bool closed, double width,
                const ScreenSides& pixel, Coverage& coverage);

// Adds a band about the curve on the camera's sphere that `direction` follows as its argument goes
// from 0 to 1.  The curve is divided finely enough for the image of the projection.  It is left out
// where it comes near to the one direction without an image.
void add_curve(const std::function<V3d(double)>& direction, bool closed, double width,
               const Projection& projection, Coverage& coverage);
void add_curve(const ViewCurve& curve, double width, const Projection& projection,
               Coverage& coverage);

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
  if (!traits_of(projection).has_seam) return;
  use(-1.0 * columns(projection));
  use(1.0 * columns(projection));
}

// Adds a polygon of points that were placed one by one.  A polygon around a pole covers everything
// between its line and the edge of the image at that pole.
void add_unwound(ImagePolygon polygon, const Projection& projection, Coverage& coverage);

}  // namespace domefall
