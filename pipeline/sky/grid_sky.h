// The built-in sky: a checkerboard of 5 degrees in right ascension and declination.  All squares
// are blackbodies of 8000 K, the light ones four times as bright as the dark ones.  Discs at the
// poles, 5 degrees across, are redder (2000 K) and brighter.  [Riazuelo] sec. ssec_bckgsky.
#pragma once

#include "pipeline/colour/colour_space.h"
#include "trajectories/directions.h"

namespace domefall {

// The light of a place in its two parts, which have each a colour of their own: luminance (cd/m^2)
// at no redshift.
struct GridLight {
  float squares, discs;
};

// At frequency ratio g = observed/emitted a blackbody of T is seen at g T.  cd/m^2, working space.
WorkingRgb grid_colour(const GridLight& light, double g);

// The light in a direction, averaged over a square of `footprint` (>= 0) radians on the sky.
GridLight grid_light(const SkyDirection& direction, double footprint);

// Many places at a time, column by column: directions, which need be no unit vectors; the footprint
// of each (>= 0, radians), and a reach (>= 0, radians).
struct GridPlaces {
  const double *x, *y, *z, *footprint, *reach;
};
// Where their light goes.  `even` becomes 1 where no border of a square or disc is within the
// reach, so that the light is right for any footprint of that radius, whatever its shape; else 0.
struct GridLights {
  float *squares, *discs, *even;
};
void grid_lights(const GridPlaces& places, int count, const GridLights& lights);

}  // namespace domefall
