// What overlays are drawn with.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_ref.h"

namespace domefall {

// Light that replaces what is behind it.
struct Ink {
  WorkingRgb light;    // pixel values
  double opacity = 1;  // 0 to 1
};

// Draws over a frame of the projection's size, where the projection shows anything.
void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               const FrameRef& frame);

// The same, outside a dome's circle too.
void draw_anywhere(const Coverage& coverage, const Ink& ink, const FrameRef& frame);

}  // namespace domefall
