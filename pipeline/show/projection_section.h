// The keys of a show that say what its pictures are: camera.projection with camera.cut, and size.
#pragma once

#include "pipeline/show/section.h"
#include "projections/projection.h"

namespace domefall {

// Reads the projection with the show's `size`, whose form depends on it.  Its opening angle, where
// there are several, is the default: 90 degrees of a flat picture, 180 of a fisheye.
Projection read_projection(const Section& show, const Section& camera);

// The bounds of an opening angle, degrees; nothing if the projection has one only.
std::optional<Range> fov_range(const Projection& projection);

}  // namespace domefall
