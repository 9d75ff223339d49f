// Overlays are drawn with Ink wherever a Coverage says.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_ref.h"

namespace domefall {

// An Ink is light that replaces the light behind it.
struct Ink {
  WorkingRgb light;    // pixel values
  double opacity = 1;  // 0 to 1
};

// Draws over a frame of the projection's size, but only where the projection shows anything.
void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               const FrameRef& frame);

// Draws over a frame everywhere, even outside a dome's circle.
void draw_anywhere(const Coverage& coverage, const Ink& ink, const FrameRef& frame);

}  // namespace domefall
