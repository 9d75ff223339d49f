// The ergosphere of a hole that spins is where nothing can stand still against the stars: within
//
//     r = 1 + sqrt(1 - q^2 - a^2 cos^2(theta)), where Delta = a^2 sin^2(theta)
//
// It begins at the horizon on the axis and at r = 2 in the equator (of a hole without charge).
#pragma once

#include <vector>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

// Says whether a place is in the ergosphere or the hole.
bool in_ergosphere(const KerrPlace& at);

// Returns the corners of the ergosphere's outline, counter-clockwise about -R as seen from where the
// directions begin, as an observer outside of it sees it who moves as the reference tetrad: at each eta
// the farthest direction from which light has been in it, and where there is none beyond 1e-4 of the way
// from the silhouette's edge to straight away from the hole, that edge.  Rays are integrated as for gas
// (light_path.h).
std::vector<V3d> ergosphere_outline(const KerrPlace& at);

}  // namespace domefall
