// Some skies have their light crowded into less than a pixel: the sky of region III a moment after
// the crossing, the sky of a static observer just above the horizon, or whatever lies ahead of a
// very fast observer.  Rays through pixels would miss such a sky or hit it by chance.  Its light is
// therefore integrated over directions on the sky, in which it is smooth, and drawn like a star.
// All of it then arrives wherever the sky lies between pixels.
#pragma once

#include <vector>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/sky/pixel_shader.h"

namespace domefall {

struct UnresolvedSkies {
  std::vector<DarkenedCap> darkened;  // what the blobs replace, and pixels leave out
  std::vector<CapBlob> blobs;
};

// Finds at most two caps for each sky.  An ordinary frame has none, and a few rays suffice to find
// that out.  Each cap takes some 10 ms.  Its flux, from 74,000 samples, is within 1 % of the
// integral over the sky.
UnresolvedSkies find_unresolved_skies(const FrameScene& scene);

}  // namespace domefall
