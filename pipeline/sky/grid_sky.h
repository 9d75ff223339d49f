// The built-in sky: a checkerboard of 5 degrees in right ascension and declination.  All squares
// are 8000 K blackbodies, light ones four times as bright as dark ones; discs of 5 degrees diameter
// at the poles are redder (2000 K) and brighter.  [Riazuelo] sec. ssec_bckgsky.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "trajectories/directions.h"

namespace domefall {

// Light of the grid (cd/m^2, working space) in a direction, averaged over a square of `footprint`
// radians on the sky, at frequency ratio g = observed/emitted: each blackbody is seen at g T.
WorkingRgb grid_light(const SkyDirection& direction, double footprint, double g);

}  // namespace domefall
