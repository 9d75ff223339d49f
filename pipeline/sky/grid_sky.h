// The built-in sky: a checkerboard of 5 degrees in right ascension and declination.  All squares
// are blackbodies of 8000 K, the light ones four times as bright as the dark ones.  Discs at the
// poles, 5 degrees across, are redder (2000 K) and brighter.  [Riazuelo] sec. ssec_bckgsky.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "trajectories/directions.h"

namespace domefall {

// Returns the light of the grid (cd/m^2, working space) in a direction, averaged over a square of
// `footprint` (>= 0) radians on the sky.  At frequency ratio g = observed/emitted a blackbody of T
// is seen at g T.
WorkingRgb grid_light(const SkyDirection& direction, double footprint, double g);

// Returns whether no border of a square or disc is within `reach` (>= 0) radians of a direction, so
// that grid_light is right for any footprint of that radius, whatever its shape.
bool grid_is_even(const SkyDirection& direction, double reach);

}  // namespace domefall
