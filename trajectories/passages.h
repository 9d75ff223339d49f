// When a trajectory is where.
#pragma once

#include <optional>
#include <utility>

#include "trajectories/trajectory.h"

namespace domefall {

// The proper time after which the trajectory begins: at the past singularity, or just before the
// first key of a path; -infinity without either.
double birth(const Trajectory& trajectory);

// The first proper time >= after at which r (M) is passed on that leg; nothing if never, or if r
// does not change.
std::optional<ProperTime> time_at(
    const Trajectory& trajectory, double r, Leg leg,
    const ProperTime& after = -std::numeric_limits<double>::infinity());

// The smallest and the largest r of its whole life, M.
std::pair<double, double> reach(const Trajectory& trajectory);

}  // namespace domefall
