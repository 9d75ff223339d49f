// This file says when a trajectory is where.
#pragma once

#include <optional>
#include <utility>

#include "trajectories/trajectory.h"

namespace domefall {

// Returns the proper time after which the trajectory begins.  It is that of the past singularity,
// or just before the first key of a path, and -infinity without either.
double birth(const Trajectory& trajectory);

// Returns the first proper time >= after at which r (M) is passed on that leg.  Returns nothing if
// it never is, or if r does not change.
std::optional<ProperTime> time_at(
    const Trajectory& trajectory, double r, Leg leg,
    const ProperTime& after = -std::numeric_limits<double>::infinity());

// Returns the smallest and the largest r of its whole life, in M.
std::pair<double, double> reach(const Trajectory& trajectory);

}  // namespace domefall
