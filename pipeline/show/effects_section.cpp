#include "pipeline/show/effects_section.h"

#include <algorithm>
#include <cmath>

#include "pipeline/show/frame_state.h"

namespace domefall {
namespace {

bool read_switch(const Section& section, std::string_view key) {
  return section.choice(key, {"true", "false"}).value_or(0) == 0;
}

bool is_within(const FrameState& state) {
  return !(state.observer.r > 2) || (state.vanishing && is_within(*state.vanishing));
}

// A frame on or inside a horizon, if there is one.  Nothing that is inside the black hole was not
// inside before at the end of its segment, and what comes out of a white hole is inside at the start:
// the frames next to the ends of segments and of dissolves tell.
std::optional<FrameState> frame_within(const Show& show) {
  const int last = frame_count(show) - 1;
  std::vector<double> ends = segment_times(show);
  for (std::size_t k = 0; k < show.timeline.size(); ++k)
    ends.push_back(ends[k] + show.timeline[k].dissolve_s);
  for (const double seconds : ends) {
    const int end = static_cast<int>(std::lround(seconds * show.frames_per_second));
    for (int frame = std::max(end - 1, 0); frame <= std::min(end + 1, last); ++frame) {
      FrameState state = frame_state(show, frame);
      if (is_within(state)) return state;
    }
  }
  return std::nullopt;
}

}  // namespace

Effects read_effects(const Section& show) {
  const Section s = subsection(
      show, "effects", {"aberration", "doppler_colour", "intensity", "lensing", "amplification"});
  Effects effects;
  effects.aberration = read_switch(s, "aberration");
  effects.doppler_colour = read_switch(s, "doppler_colour");
  effects.intensity = read_switch(s, "intensity");
  effects.lensing = read_switch(s, "lensing");
  constexpr Amplification kBy[] = {Amplification::kStars, Amplification::kNone,
                                   Amplification::kEverything};
  effects.amplification =
      kBy[s.choice("amplification", {"stars", "none", "everything"}).value_or(0)];
  return effects;
}

void check_effects(const Item& root, const Show& show) {
  if (show.effects.lensing) return;
  const auto within = frame_within(show);
  if (!within) return;
  const auto effects = peek(root, "effects");
  const auto lensing = effects ? peek(*effects, "lensing") : std::nullopt;
  (lensing ? *lensing : root)
      .fail("can be false outside the horizon only (r > 2), but frame " +
            std::to_string(within->frame) + ", in timeline[" + std::to_string(within->segment) +
            "], lies at r = " + short_number(within->observer.r) + " (units of M)");
}

}  // namespace domefall
