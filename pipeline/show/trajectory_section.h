// The section `trajectory` of a segment says how its observer moves.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/timing_section.h"

namespace domefall {

struct TimedTrajectory {
  Trajectory trajectory;
  Timing timing;
  Placement placement;
};

// Reads `region`, which is I or III, and says whether it is III.  Both have the same orbits.
bool is_in_region_three(const Section& s);

// Reads a trajectory of any type, or reports an error and returns nothing.
std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup);

}  // namespace domefall
