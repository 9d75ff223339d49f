// A sky whose light is crowded into less than a pixel: that of region III a moment after the crossing, that
// of a static observer just above the horizon, or whatever lies ahead of a very fast one.  Rays through
// pixels would miss it or hit it by chance.  It is integrated from the side of the sky, where it is smooth,
// and drawn like a star, so that its light arrives whole wherever between pixels it falls.
#pragma once

#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/sky/pixel_shader.h"

namespace domefall {

struct UnresolvedSkies {
  std::vector<DarkenedCap> darkened;  // what the blobs stand for, and the pixels must leave out
  std::vector<CapBlob> blobs;
};

// At most two for each sky.  An ordinary frame has none, which a few rays tell; else each costs some
// 10 ms.  The flux is within 1 % of the integral over the sky (74,000 samples).
UnresolvedSkies find_unresolved_skies(const FrameScene& scene);

}  // namespace domefall
