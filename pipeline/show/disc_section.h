// The section `disc` of a show describes the gas that circles the hole.
#pragma once

#include <optional>

#include "pipeline/disc/disc.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads the disc, or returns nothing where the show has none.  Its plane is given against that of
// an orbit which sets out as `to` says, so that the hole's place and heading must have been read.
std::optional<Disc> read_disc(const Section& show, const Show& to);

}  // namespace domefall
