// The instants at which something happens to the observer of a show.
#pragma once

#include <optional>

#include "pipeline/show/show.h"

namespace domefall {

// Returns the show second of the first instant of an event, or nothing for one that no segment has.
// The show must have its joints.  The way is followed in steps of a quarter of a frame, so that two
// turns within one may be missed.
std::optional<double> time_of(const MarkerEvent& event, const Show& show);

}  // namespace domefall
