// The section `stars` of a show says how stars are drawn.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Sets the point-spread law, with the defaults of its two forms, `law: size` and `law: psf`.  Also
// sets the saturation and the least radius of stars, and the gain that they have in skies for which
// read_sky finds none.
void read_stars(const Section& show, Show& to);

// Returns the gain that stars have under a law where a show names none.
double default_star_gain(const PointSpreadLaw& law);

}  // namespace domefall
