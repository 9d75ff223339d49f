// Everything that is drawn over a frame because somebody asked for it.
#pragma once

#include <string>

#include "pipeline/render/overlay/frame_ref.h"
#include "pipeline/render/overlay/star_labels.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// A digest of what the overlays of a show change in a frame beyond what its own key holds: which
// they are, their texts, and the fonts.  Empty for a show without overlays.  Throws as lettering()
// and Lettering::letter where an overlay has text.
std::string overlays_key(const Show& show, const FrameState& state);

// Draws the show's overlays over a frame, in their order.  `labels` are those of the show.  Throws
// as above and as StarLabels.
void draw_overlays(const Show& show, const FrameState& state, StarLabels& labels,
                   const FrameRef& frame);

}  // namespace domefall
