// The show's `sky`: one for each region.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// `show` is the root, which stands for a sky section that is left out.
void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show);

}  // namespace domefall
