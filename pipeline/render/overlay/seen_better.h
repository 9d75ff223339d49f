// Of which view overlays tell in a dissolve.
#pragma once

#include "pipeline/show/frame_state.h"

namespace domefall {

// The state itself, or in a dissolve the one that vanishes as long as it has more of the light.
inline const FrameState& seen_better(const FrameState& state) {
  return state.vanishing_part > 0.5 ? *state.vanishing : state;
}

}  // namespace domefall
