// What one frame of a show needs: nothing else is loaded, tabulated or drawn.
#pragma once

#include "pipeline/show/frame_state.h"
#include "trajectories/sky_region.h"

namespace domefall {

// What one frame needs, decided before anything is made.
struct FramePlan {
  bool gravity = false;  // else no table
  struct Sky {
    bool background = false;  // anything to see but stars
    bool stars = false;
    bool rings = false;  // lit by the time at which its light started

    bool lit() const { return background || stars; }
  };
  PerSky<Sky> sky;  // what can be seen from the observer's region

  const Sky& operator[](SkyRegion which) const { return sky[which]; }
  bool background() const;
};

FramePlan plan_frame(const Show& show, const FrameState& state);

}  // namespace domefall
