// Lines as bands of even width.
#pragma once

#include <functional>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/rays/view_circle.h"

namespace domefall {

// Adds a band of that width (pixels) about a line through points.  A closed one goes on from its
// last point to its first.  At corners the band keeps its width up to right angles, as curves of
// many points and boxes need it.
void add_stroke(const std::vector<PicturePoint>& line, bool closed, double width,
                Coverage& coverage);

// The same about the curve `direction`(0 to 1) on the sphere of the camera, in as many pieces as a
// picture of the projection shows.  It is left out where it comes near to the one direction without
// an image.
void add_curve(const std::function<V3d(double)>& direction, bool closed, double width,
               const Projection& projection, Coverage& coverage);
void add_circle(const ViewCircle& circle, double width, const Projection& projection,
                Coverage& coverage);

}  // namespace domefall
