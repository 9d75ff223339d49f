// The section `bodies` of a show file: what shines on orbits of its own.
#pragma once

#include <vector>

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// `to` has its black hole.  Reports bodies of a show without one.
std::vector<Body> read_bodies(const Section& show, const Show& to, Lookup& lookup);

}  // namespace domefall
