// A sky whose light is crowded into less than a pixel: region III a moment after the crossing, the sky
// of a static observer just above the horizon, or whatever lies ahead of a very fast one.  Looks through
// pixels would miss it or hit it by chance.  Such a spot is integrated from the side of the sky, where it
// is smooth, and drawn like a star: the light arrives whole, wherever between pixels it falls.
#pragma once

#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/sky/pixel_shader.h"

namespace domefall {

struct UnresolvedSkies {
  std::vector<DarkenedCap> darkened;  // what the blobs stand for, and looks must leave out
  std::vector<CapBlob> blobs;
};

// At most two for each sky.  None, after a few looks, in an ordinary frame; else some 10 ms each.
// Flux: within 1 % of the integral over the sky (74,000 samples).
UnresolvedSkies find_unresolved_skies(const Show& show, const FrameState& state,
                                      const HoleOptics& optics, const PixelShader::Skies& skies);

}  // namespace domefall
