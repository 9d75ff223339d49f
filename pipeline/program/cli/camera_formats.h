// The camera of a show in the formats of other programs (camera_world.h says in which world).
#pragma once

#include <string>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

// Returns a .chan file: a line for each frame with its number, the place of the camera, which is
// always the origin, the angles rx, ry and rz in degrees, of rotations about z, then x, then y, as
// Nuke has them, and for a rectilinear picture the vertical angle of view.
std::string camera_chan(const Show& show, const std::vector<int>& frames);

// Returns a USD stage as text.  /Domefall/Audience is turned as the audience is against the world,
// and its child Camera as the picture is against the audience.
std::string camera_usda(const Show& show, const std::vector<int>& frames);

}  // namespace domefall
