// The show's `stars`: how stars are drawn.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Sets the law of point spread, with the defaults of its two forms, `law: size` and `law: psf`, the
// least radius of stars, and the gain that the skies have where read_sky finds none.
void read_stars(const Section& show, Show& to);

// The gain that stars have under a law where a show names none.
double default_star_gain(const PointSpreadLaw& law);

}  // namespace domefall
