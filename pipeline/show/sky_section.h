// The section `sky` of a show gives each region its sky.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads the section into `show`.  A shipped file that is missing is reported at `root`, the whole
// file, since the section may be left out.
void read_sky(const Item& root, const Section& section, Lookup& lookup, Show& show);

// Reads the backgrounds that a segment's `sky` gives.  Those of the show stand for what it leaves
// out.  Unknown keys are reported by read_values (channel_values.h).
void read_backgrounds(const Item& sky, const Lookup& lookup, const PerSky<RegionSky>& of_show,
                      PerSky<std::optional<SkyBackground>>& backgrounds);

}  // namespace domefall
