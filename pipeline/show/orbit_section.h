// These functions read the trajectories of free fall other than the circle and the radial fall from
// rest at infinity.  Each reads those of one type, and returns nothing for one that is in error.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

std::optional<TimedTrajectory> read_parabolic(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_hyperbolic(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_bound(const Item& item, const Stage& stage);
// Reads falls from rest at a finite radius, with a speed at infinity, or with angular momentum.
std::optional<TimedTrajectory> read_curved_infall(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_thrown(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_kruskal(const Item& item, const Stage& stage);

}  // namespace domefall
