// A lens map says for each pixel of a frame where on the sky its light started and what became of
// it.  Other programs lens pictures of their own by these numbers.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// The channels, in the order of the pixels' numbers (docs/lens_maps.md).
enum LensChannel {
  kSkyX,  // unit vector on the sky, equatorial J2000
  kSkyY,
  kSkyZ,
  kStS,  // place on a map by longitude and latitude: from the left and the bottom, 0 to 1
  kStT,
  kSkyRegion,      // 1, 3, 4, or 5 for that of the next universe; 0 outside the image, where all
                   // other channels are 0, too
  kOnePlusZ,       // 0 for the past singularity's light, as are the next two
  kAmplification,  // over the pixel's width
  kOrder,          // of the image: whole half turns about the hole
  kEdgeDistance,   // degrees in the view to the nearest edge of a sky; 180 where there is none
  kGasRadius,      // M, of the disc where the pixel's ray meets it first; 0 where it does not, as
                   // are the next four
  kGasAzimuth,     // degrees about the disc's axis from its node
  kGasOnePlusZ,
  kGasOrder,    // of the image: 0 for the direct one
  kGasCovered,  // the part of the pixel that this image covers
  kLensChannels,
};
const std::vector<std::string>& lens_channel_names();

// A SkyMapPlace is a place on a map of the sky by longitude and latitude as shows take it: north is
// up, and RA is 0 in the middle and grows to the left.
struct SkyMapPlace {
  double s, t;  // 0 <= s < 1 from the left, 0 <= t <= 1 from the bottom
};
// Returns the place of a direction (unit, equatorial J2000).
SkyMapPlace sky_map_place(const V3d& direction);

// Returns the key of a frame's lens map, a digest of all that it depends on.  No asset is read for
// it.
std::string lens_map_key(const Show& show, const FrameState& state);

// Makes the lens map of an instant by `threads` threads.  Each pixel is described at its centre,
// by the exact ray of ViewTracer::trace.  In a dissolve it is the map of the view with more of the
// light.
ChannelImage make_lens_map(const Show& show, const FrameState& state, int threads);

}  // namespace domefall
