#include "pipeline/show/effects_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/show/effect_names.h"
#include "pipeline/show/frame_state.h"

namespace domefall {
namespace {

// Reads a switch, which is on as in nature unless the show turns it off.
bool read_switch(const Section& section, std::string_view key) {
  return section.word<bool>(key, {{"true", true}, {"false", false}}).value_or(true);
}

// Returns the state on or inside a horizon among those that make up a frame, or null if there is
// none.  A frame has one state, or two in a dissolve.
const FrameState* within(const FrameState& state) {
  if (!(state.observer.r > 2)) return &state;
  return state.vanishing ? within(*state.vanishing) : nullptr;
}

// Returns a frame on or inside a horizon, if there is one.  What falls in stays inside to the end
// of its segment, and what comes out of the white hole is inside at its start.  So it is enough to
// test the frames next to the ends of segments and of dissolves.
std::optional<FrameState> frame_within(const Show& show) {
  const int last = frame_count(show) - 1;
  std::vector<double> ends = segment_times(show);
  for (std::size_t k = 0; k < show.timeline.size(); ++k)
    ends.push_back(ends[k] + show.timeline[k].dissolve_s);
  for (const double seconds : ends) {
    const int end = static_cast<int>(std::lround(seconds * show.frames_per_second));
    // The nearest frame and its neighbours lie on both sides of the end.
    for (int frame = std::max(end - 1, 0); frame <= std::min(end + 1, last); ++frame) {
      const FrameState state = frame_state(show, frame);
      if (const FrameState* found = within(state)) return *found;
    }
  }
  return std::nullopt;
}

}  // namespace

Effects read_effects(const Section& show) {
  const Section s = subsection(
      show, "effects", {"aberration", "doppler_colour", "intensity", "lensing", "amplification"});
  Effects effects;
  for (const auto& [name, effect] : kEffectSwitches) effects.*effect = read_switch(s, name);
  // Nature amplifies stars alone, since a lens keeps the brightness per solid angle of what has an
  // extent.
  effects.amplification =
      s.word<Amplification>("amplification", kAmplifications).value_or(Amplification::kStars);
  return effects;
}

void check_effects(const Item& root, const Show& show) {
  if (show.effects.lensing) return;
  const auto found = frame_within(show);
  if (!found) return;
  const auto effects = peek(root, "effects");
  const auto lensing = effects ? peek(*effects, "lensing") : std::nullopt;
  (lensing ? *lensing : root)
      .fail(fmt::format("can be false outside the horizon only (r > 2), but frame {}, in "
                        "timeline[{}], lies at r = {} (units of M)",
                        found->frame, found->segment + 1, short_number(found->observer.r)));
}

}  // namespace domefall
