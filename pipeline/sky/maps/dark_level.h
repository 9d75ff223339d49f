// The dark level of a sky map: the light of its own darkest parts.
//
// A picture of the sky has a floor that no eye sees as light: what the camera, the airglow and the
// zodiacal dust added, or what the sum of all faint stars leaves between the clouds of the Milky
// Way.  Shows take this level as black.
#pragma once

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

struct DarkLevel {
  double light = 0;      // cd/m^2 of a colour map, W/m^2/sr of a thermal one
  double luminance = 0;  // cd/m^2 of the same light at frequency ratio 1
};

// The light that 1 % of the sphere falls below, each texel counting as its solid angle.  It is
// measured on the first level of at most 64 texels along an edge of a face, which are 1.4 degrees,
// so that neither a star's gap nor the noise of a picture decides.  It follows from the map alone.
// It is 0 if it exceeds 3/4 of what half of the sphere falls below: a sky so even has no dark
// parts.
DarkLevel dark_level(const SkyMap& map);

// The light (in the unit of DarkLevel::light) that has this luminance in cd/m^2, if it has the
// temperature of the map's darkest parts.  For a colour map it is the luminance itself; for a
// thermal one without any visible light it is 0.
double light_of_luminance(const SkyMap& map, double luminance);

}  // namespace domefall
