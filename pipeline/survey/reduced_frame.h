// Frames at a reduced size, by which a survey samples a show in less time than rendering takes.
#pragma once

#include "pipeline/show/frame_state.h"

namespace domefall {

// The same projection with `width` columns.  A flat one keeps its field of view and, to rounding,
// the shape of its pixels, but has 16 rows at least.
Projection reduced(const Projection& projection, int width);

// The same frame in that projection, and so is the one that dissolves into it.
FrameState reduced(FrameState state, int width);

// The same frame with no star in any sky.
FrameState without_stars(FrameState state);

}  // namespace domefall
