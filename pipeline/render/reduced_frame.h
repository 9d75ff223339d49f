// A survey samples a show with frames at a reduced size, which take less time than rendering it.
#pragma once

#include "pipeline/render/renderer.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Frames at a reduced size need no more detail than this.  Texels are 0.7 degrees wide, while a pixel
// of 48 has 4.  Some thousand stars are enough, since each of them covers several pixels.
inline constexpr SkyDetail kSurveyDetail{128, 512};

// Returns the same projection with `width` columns.  A flat one keeps its field of view and, to
// rounding, the shape of its pixels, but has at least 16 rows.
Projection reduced(const Projection& projection, int width);

// Returns the same frame in that projection.  The view that dissolves into it is reduced, too.
FrameState reduced(FrameState state, int width);

// Returns the same frame with no star in any sky.
FrameState without_stars(FrameState state);

// Returns the state for a passing look (FrameState::draft).
FrameState as_draft(FrameState state);

}  // namespace domefall
