// In a dissolve there are two views, and overlays with text describe one of them.
#pragma once

#include "pipeline/show/frame_state.h"

namespace domefall {

// Returns the state itself, or in a dissolve the vanishing one as long as that has more of the
// light.
inline const FrameState& seen_better(const FrameState& state) {
  return state.vanishing_part > 0.5 ? *state.vanishing : state;
}

}  // namespace domefall
