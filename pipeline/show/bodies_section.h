// The section `bodies` of a show file lists what shines on orbits of its own.
#pragma once

#include <vector>

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads the bodies of a show.  The black hole of `to` must have been read.  Reports bodies of a
// show without a hole.
std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup);

}  // namespace domefall
