// An observer can ride with a body of the show, and then moves as the body does.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads a trajectory of type `body`, or reports an error and returns nothing.
std::optional<TimedTrajectory> read_ride(const Item& item, const Stage& stage);

}  // namespace domefall
