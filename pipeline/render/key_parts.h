// Adds to digests what the keys of frames and of lens maps have in common.
#pragma once

#include <optional>

#include "pipeline/base/digest.h"
#include "pipeline/show/show.h"
#include "projections/projection.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Each of these functions adds all of its second argument, with numbers as key_rounding.h rounds them.
void add_observer(Digest& digest, const ObserverState& observer);
void add_projection(Digest& digest, const Projection& projection);
// Shows that leave no effect out keep the keys that they had before effects could be left out.
void add_effects(Digest& digest, const Effects& effects);
// A show without a disc adds nothing.
void add_disc(Digest& digest, const std::optional<Disc>& disc);
void add_gas(Digest& digest, const Show& show);  // its halo and its jet

}  // namespace domefall
