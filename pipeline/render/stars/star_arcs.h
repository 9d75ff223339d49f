// The images of a star that stands behind the hole, or right above it: arcs and rings.
//
// Where source, hole and observer are in line the amplification of a point diverges like 1/sin of
// its angle from the axis.  A picture shows no points: the star counts there as an even disc of the
// size that a pixel has.  The light of its image is what the map makes of that disc: the solid
// angle of an arc about the axis and finally a ring, finite and known.
//
// It is drawn as that arc while the axis lies in the disc.  Outside, the arc is gathered to a point
// from both its ends, until at three radii it is one: else all stars nearer to the axis than
// Einstein's ring were arcs, so much it stretches any disc.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/optics/hole_optics.h"

namespace domefall {

// A star nearer to the axis than this many radii has the light of the disc: beyond, that is the
// light of its middle to 1/(8 * 8^2), two parts in a thousand.
inline constexpr double kNearAxis = 8;

// Whether images of this order are on a caustic for a source near the axis, on this side of it: all
// are but the primary of a source above.
inline bool on_caustic(const V3d& source, int order) { return source.x < 0 || order > 0; }

// The image of an even disc of the given radius (radians, > 0, small) about `source`, in pieces
// from one end of the arc to the other, each with its part of the amplification.  A piece is no
// longer than spacing(its direction), but for a limit of 4096 pieces.
std::vector<SkyImage> arc_of(const SkyTable& table, const V3d& source, int order, double radius,
                             const std::function<double(const V3d&)>& spacing);

}  // namespace domefall
