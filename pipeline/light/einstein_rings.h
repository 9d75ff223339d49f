// A star that stands behind the hole, or right above the observer, is seen as an arc or a ring.
//
// Where source, hole and observer are in line, the amplification of a point diverges like 1/sin of
// its angle from this axis.  A frame resolves no points, so near the axis a star is an even disc
// about as large as a pixel.  Its light is the solid angle of the image of that disc, which is
// finite.  The image is an arc about the axis, or a ring if the axis lies in the disc.
//
// The image is drawn as a ring while the axis lies in the disc.  Outside, the arc is shortened from
// both ends, until at three radii from the axis it is a point.  Otherwise every star inside the
// Einstein ring would be drawn as an arc, since the lens stretches any disc there.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/light/hole_optics.h"

namespace domefall {

// Returns the image of an even disc of this radius (radians, > 0, small) about `source`, in pieces
// from one end of the arc to the other.  Each piece has its part of the amplification.  No piece is
// longer than spacing(direction) anywhere on the arc, unless that takes more than 4096 pieces.
std::vector<SkyImage> arc_of(const SkyTable& table, const V3d& source, int order, double radius,
                             const std::function<double(const V3d&)>& spacing);

}  // namespace domefall
