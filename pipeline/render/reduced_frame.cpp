#include "pipeline/render/reduced_frame.h"

#include <algorithm>

#include "projections/projection.h"

namespace domefall {

Projection reduced(const Projection& projection, int width) {
  constexpr int kLeastRows = 16;
  const Projection small = with_width(projection, width);
  // Of a very wide picture hardly a row would be left.
  return with_sides(small, width, std::max(kLeastRows, rows(small)));
}

FrameState reduced(FrameState state, int width) {
  state.projection = reduced(state.projection, width);
  if (state.vanishing)
    state.vanishing = std::make_shared<const FrameState>(reduced(*state.vanishing, width));
  return state;
}

// The gain is a number of the frame, so one renderer makes the frame with stars and without.
FrameState without_stars(FrameState state) {
  for (const SkyRegion sky : kEverySky) state.settings.sky[sky].star_gain = 0;
  if (state.vanishing)
    state.vanishing = std::make_shared<const FrameState>(without_stars(*state.vanishing));
  return state;
}

FrameState as_draft(FrameState state) {
  state.draft = true;
  if (state.vanishing)
    state.vanishing = std::make_shared<const FrameState>(as_draft(*state.vanishing));
  return state;
}

}  // namespace domefall
