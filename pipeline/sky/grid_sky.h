// The built-in sky is a checkerboard of 5 degrees in right ascension and declination.  All squares
// are blackbodies of 8000 K, and the light ones are four times as bright as the dark ones.  Discs
// at the poles, 5 degrees across, are redder (2000 K) and brighter.  [Riazuelo] sec. ssec_bckgsky.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "trajectories/directions.h"

namespace domefall {

// The light of a place has two parts, squares and discs, since each has a colour of its own.  Both
// are luminances (cd/m^2) at no redshift.
struct GridLight {
  float squares, discs;
};

// Returns the colour (cd/m^2, working space) of the light at a frequency ratio g =
// observed/emitted.  A blackbody of temperature T is then seen as one of g T.
WorkingRgb grid_colour(const GridLight& light, double g);

// Returns the light in a direction, averaged over a square of `footprint` (>= 0) radians on the
// sky.
GridLight grid_light(const SkyDirection& direction, double footprint);

// These are many places at a time, column by column: their directions, whose lengths may differ
// from 1 by rounding or interpolation, the footprint of each (>= 0, radians), and a reach (>= 0,
// radians).
struct GridPlaces {
  const double *x, *y, *z, *footprint, *reach;
};
// The light of the places goes here.  `even` becomes 1 where no border of a square or disc is
// within the reach, so that the light is right for any footprint of that radius, whatever its
// shape.  Elsewhere it becomes 0.
struct GridLights {
  float *squares, *discs, *even;
};
void grid_lights(const GridPlaces& places, int count, const GridLights& lights);

}  // namespace domefall
