// Skies that are formulas: the grid, and the rings of the past singularity.
//
// The built-in sky, the grid, is a checkerboard of 5 degrees in right ascension and declination.  All squares
// are blackbodies of 8000 K, and the light ones are four times as bright as the dark ones.  Discs
// at the poles, 5 degrees across, are redder (2000 K) and brighter.  [Riazuelo] sec. ssec_bckgsky.
#pragma once

#include "pipeline/sources/colour/colour_space.h"
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

// The glow of the past singularity is a function of the time t at which its light started: "a
// series of rings of variable t", [Riazuelo] sec. sec_Kruskal.
//
// Returns the light (cd/m^2, working space) of a 3000 K blackbody at `phase` = t/period.  Its
// luminance is a raised cosine, brightest at whole numbers, between the luminances of the grid's
// light and dark squares.  To average over a footprint of `width` (>= 0) periods, the cosine is
// multiplied by exp(-(pi width)^2/6).  The mean over a box has the factor sin(pi width)/(pi width)
// instead, whose series begins with the same 1 - (pi width)^2/6.  The exponential has none of its
// ripples, so that rings finer than a pixel fade to their mean.
WorkingRgb ring_glow(double phase, double width);

// These functions return the light in two parts: the colour, whose luminance is 1, and the
// luminances of many places.
WorkingRgb ring_colour();
void ring_lights(const float* phase, const float* width, int count, float* luminance);

}  // namespace domefall
