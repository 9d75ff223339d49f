// What one frame of a show needs.  Nothing else is loaded, tabulated or drawn for it.
#pragma once

#include "pipeline/show/frame_state.h"
#include "trajectories/sky_region.h"

namespace domefall {

struct FramePlan {
  bool gravity = false;  // whether light is bent, which takes tables
  struct Sky {
    bool background = false;  // whether it shows anything but stars
    bool stars = false;
    bool rings = false;  // whether its light depends on when it started
    // The segment's, which the show owns; null where the plan is not made of a show.
    const SkyBackground* shown = nullptr;

    bool lit() const { return background || stars; }
  };
  bool disc = false;  // whether light of the disc, in region I, can reach the observer
  PerSky<Sky> sky;    // all false for a sky that the observer's region does not see

  const Sky& operator[](SkyRegion which) const { return sky[which]; }
  bool has_background() const;
};

// Follows from the observer's region, the show's skies and the gains at this instant, without
// loading anything.
FramePlan plan_frame(const Show& show, const FrameState& state);

}  // namespace domefall
