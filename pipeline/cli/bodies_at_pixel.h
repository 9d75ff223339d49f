// This file finds the bodies of a show whose images a pixel shows.
#pragma once

#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"
#include "projections/projection.h"

namespace domefall {

struct BodyAtPixel {
  std::string name;
  double r;                // of the body when the light left it, M
  double seen_v;           // of the image
  double frequency_ratio;  // observed / emitted
  int order;               // of the image
  PixelPosition at;        // of its middle
};

// Returns the images that reach the pixel, the brightest first.  An image reaches it if the
// smallest blob of the frame would, drawn at the image's middle or at that of a piece that the
// image is drawn in.
std::vector<BodyAtPixel> bodies_at_pixel(const Show& show, const FrameState& state,
                                         PixelPosition pixel);

}  // namespace domefall
