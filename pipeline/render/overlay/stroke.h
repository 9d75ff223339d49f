// Lines are drawn as bands of even width.
#pragma once

#include <functional>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/rays/view_circle.h"

namespace domefall {

// Adds a band of this width (pixels) about a line through points.  A closed line goes on from its
// last point to its first.  Where the line turns by a right angle or less, the band keeps its width
// at the corner.  Boxes and curves of many points need no more.
void add_stroke(const std::vector<ImagePoint>& line, bool closed, double width, Coverage& coverage);

// Adds a band about the curve on the camera's sphere that `direction` follows as its argument goes
// from 0 to 1.  The curve is divided finely enough for the image of the projection.  It is left out
// where it comes near to the one direction without an image.
void add_curve(const std::function<V3d(double)>& direction, bool closed, double width,
               const Projection& projection, Coverage& coverage);
void add_circle(const ViewCircle& circle, double width, const Projection& projection,
                Coverage& coverage);

}  // namespace domefall
