// These functions draw the overlays of a show over its frames: marks, names of stars and numbers.
#pragma once

#include <string>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/star_labels.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Returns a digest of everything that the overlays of a show change in a frame and that the frame's
// own key does not hold.  This is which overlays there are, their texts, and the fonts.  The digest
// is empty for a show without overlays.  Throws as lettered() where an
// overlay has text.
std::string overlays_key(const Show& show, const FrameState& state);

// Draws the show's overlays over a frame, in their order.  `labels` are those of the show, and `left`
// is of dominant_view(state).  Throws as overlays_key() and as StarLabels.
void draw_overlays(const Show& show, const FrameState& state, StarLabels& labels,
                   const LightLeft& left, const FrameRef& frame);

}  // namespace domefall
