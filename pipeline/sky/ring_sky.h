// The glow of the past singularity is a function of the time t at which its light started: "a
// series of rings of variable t", [Riazuelo] sec. sec_Kruskal.
#pragma once

#include "pipeline/colour/colour_space.h"

namespace domefall {

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
