// The glow of the past singularity by the time t at which its light started: [Riazuelo]
// sec. sec_Kruskal, "a series of rings of variable t".
#pragma once

#include "pipeline/colour/colour_space.h"

namespace domefall {

// Light (cd/m^2, working space) at `phase` = t/period: a raised cosine, brightest at whole numbers,
// with the grid's lightest and darkest luminance, of a 3000 K blackbody.  Averaged over a footprint
// that is `width` (>= 0) periods long by a factor exp(-(pi width)^2/6) on the wave, which agrees
// with a box's to second order and has none of its ripples: rings finer than a pixel fade to their
// mean.
WorkingRgb ring_glow(double phase, double width);

}  // namespace domefall
