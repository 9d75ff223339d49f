// What overlays are drawn with.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/overlay/coverage.h"

namespace domefall {

// Light that replaces what is behind it.
struct Ink {
  WorkingRgb light;    // pixel values
  double opacity = 1;  // 0 to 1
};

// Draws over a frame of the projection's size, where the projection shows anything.  T is
// Imath::half or float.
template <class T>
void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               ImageRgb<T>& frame);

}  // namespace domefall
