// The section `trajectory` of a segment says how its observer moves.
#pragma once

#include <span>
#include <string_view>

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/timing_section.h"

namespace domefall {

struct TimedTrajectory {
  Trajectory trajectory;
  Timing timing;
  Placement placement;
};

// Returns the types of trajectory that a body can follow by itself.  The others need a segment, or
// an engine.
std::span<const std::string_view> trajectories_of_bodies();

// Reads `region`, which is I or III, and says whether it is III.  Both have the same orbits.
bool is_in_region_three(const Section& s);

// Reads a trajectory of any type, or reports an error and returns nothing.
std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup);

}  // namespace domefall
