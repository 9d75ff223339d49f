// The show's `stars`: how wide and how white stars are drawn.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads the law of point spread, with the defaults of its two forms: `law: size` and `law: psf`.
PointSpreadLaw read_point_spread(const Section& show);

}  // namespace domefall
