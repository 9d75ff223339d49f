// The show's `effects`.
#pragma once

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

Effects read_effects(const Section& show);

// Reports `lensing: false` where a frame lies on or inside a horizon: nothing is at rest there whose
// straight lines light could follow.  `root` is the whole file; `show` has been read without a mistake.
void check_effects(const Item& root, const Show& show);

}  // namespace domefall
