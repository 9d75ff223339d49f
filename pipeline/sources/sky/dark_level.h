// The dark level of a sky map is the light of its own darkest parts.
//
// A panorama of the sky has a floor that no eye sees as light.  The camera, the airglow and the
// zodiacal dust add to it, and so does the sum of all faint stars between the clouds of the Milky
// Way.  Shows take this level as black.
#pragma once

#include "pipeline/sources/sky/sky_map.h"

namespace domefall {

struct DarkLevel {
  double light = 0;      // cd/m^2 of a colour map, W/m^2/sr of a thermal one
  double luminance = 0;  // cd/m^2 of the same light at frequency ratio 1
};

// Returns the light that 1 % of the sphere falls below, where each texel counts as its solid angle.
// It is measured on the first level of at most 64 texels along an edge of a face.  These are 1.4
// degrees wide, so that neither a star's gap nor the noise of a panorama decides.  The result
// follows from the map alone.  It is 0 if it exceeds 3/4 of the light that half of the sphere falls
// below, because a sky so even has no dark parts.
DarkLevel dark_level(const SkyMap& map);

// Returns the light (in the unit of DarkLevel::light) that has a luminance of 1 cd/m^2 at the
// temperature of the map's darkest parts.  For a colour map it is 1.  For a thermal map without any
// visible light it is 0.
double light_per_luminance(const SkyMap& map);

}  // namespace domefall
