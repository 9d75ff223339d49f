// Trajectories of type `path` are given point by point.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads a path through keyframes in the show file, or through the rows of a CSV file.
std::optional<TimedTrajectory> read_path(const Item& item, const Stage& stage, Lookup& lookup);

}  // namespace domefall
