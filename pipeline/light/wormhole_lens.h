// The optics of a wormhole, for an observer at rest in it.
#pragma once

#include "pipeline/light/hole_optics.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Makes them without tables.
HoleOptics make_wormhole_optics(const Wormhole& wormhole, const ObserverState& observer);

}  // namespace domefall
