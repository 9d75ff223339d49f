// Trajectories of free fall other than the circle and the fall from rest at infinity.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

std::optional<TimedTrajectory> read_parabolic(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_hyperbolic(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_bound(const Item& item, const Stage& stage);
// From rest at a finite radius, or with angular momentum.
std::optional<TimedTrajectory> read_curved_infall(const Item& item, const Stage& stage);
std::optional<TimedTrajectory> read_thrown(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_kruskal(const Item& item, const Stage& stage);

}  // namespace domefall
