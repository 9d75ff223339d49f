// Pictures of a projection in other sizes.
#pragma once

#include "projections/projection.h"

namespace domefall {

// Whether a picture may be of any width and height, and not of one shape only.
bool has_free_shape(const Projection& p);

// A picture of a free shape with these sides in pixels, both > 0.  A fisheye has at most as many
// rows as columns.
Projection with_sides(Projection p, int columns, int rows);

// The picture in the same shape and as wide as that, or up to two pixels less where its width must
// be a multiple of 2 or 3; never narrower than two or three pixels.
Projection with_width(const Projection& p, int columns);

}  // namespace domefall
