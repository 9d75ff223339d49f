// These functions read the keys that say what projection a show has: camera.projection with
// camera.cut, and size.
#pragma once

#include "pipeline/show/section.h"
#include "projections/projection.h"

namespace domefall {

// Reads the projection with the show's `size`, whose form depends on it.  A variable opening angle
// has its default, which is 90 degrees of a flat image and 180 of a fisheye.
Projection read_projection(const Section& show, const Section& camera);

// Returns the bounds of an opening angle in degrees, or nothing if the projection has only one
// angle.
std::optional<Range> fov_range(const Projection& projection);

}  // namespace domefall
