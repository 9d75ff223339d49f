// The bodies of a show whose images a pixel shows.
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

// The images whose middles, or those of the pieces that they are drawn in, are so near to the pixel
// that the smallest blob of the frame reaches it, the brightest first.
std::vector<BodyAtPixel> bodies_at_pixel(const Show& show, const FrameState& state,
                                         PixelPosition pixel);

}  // namespace domefall
