// A projection can have images of other sizes.
#pragma once

#include "projections/projection.h"

namespace domefall {

// Says whether an image may be of any width and height, and not of one shape only.
bool has_free_shape(const Projection& p);

// Returns a projection of a free shape with these sides in pixels, both > 0.  A fisheye gets at
// most as many rows as columns.  A projection of one shape only is returned as it is.
Projection with_sides(Projection p, int columns, int rows);

// Returns the projection with an image of the same shape and as wide as that, or up to two pixels
// less where its width must be a multiple of 2 or 3.  Such a width is at least that 2 or 3.
Projection with_width(const Projection& p, int columns);

}  // namespace domefall
