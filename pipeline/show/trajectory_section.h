// The keys of a segment's `trajectory`.
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

// `region`: I or III, which has the same orbits.
bool is_in_region_three(const Section& s);

std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup);

}  // namespace domefall
