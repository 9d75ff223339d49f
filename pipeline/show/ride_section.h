// The trajectory of an observer who moves as a body of the show does.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads a trajectory of type `body`.  Nothing is returned for an error, which is reported.
std::optional<TimedTrajectory> read_ride(const Item& item, const Stage& stage);

}  // namespace domefall
