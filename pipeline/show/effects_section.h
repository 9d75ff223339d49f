// The section `effects` of a show can leave effects out, to show the others one at a time.
#pragma once

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads the section.  Effects that it does not name are as in nature.
Effects read_effects(const Section& show);

// Reports `lensing: false` if a frame lies on or inside a horizon, where no frame is at rest whose
// straight lines light could follow.  `root` is the whole file, and `show` must have been read
// without a mistake.
void check_effects(const Item& root, const Show& show);

}  // namespace domefall
