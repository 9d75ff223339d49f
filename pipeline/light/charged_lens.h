// The optics of a charged hole, for an observer in the tetrad T of spacetime/charged.h.
#pragma once

#include "pipeline/light/hole_optics.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Makes them without tables, for an observer outside the inner horizon.
HoleOptics make_charged_optics(const ChargedHole& hole, const ObserverState& observer);

}  // namespace domefall
