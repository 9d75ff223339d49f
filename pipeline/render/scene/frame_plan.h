// A FramePlan says what one frame of a show needs.  Nothing else is loaded, tabulated or drawn for
// it.
#pragma once

#include "pipeline/light/lens.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

struct FramePlan {
  bool gravity = false;  // whether light is bent, which needs tables
  struct Sky {
    bool background = false;  // whether it shows anything but stars
    bool stars = false;
    bool rings = false;  // whether its light depends on when it started
    // This is the background of the segment, which the show owns.  It is null where the plan was
    // not made from a show.
    const SkyBackground* shown = nullptr;

    bool lit() const { return background || stars; }
  };
  bool disc = false;  // whether light of the disc, in region I, can reach the observer
  // Gas that light goes through: a disc with a height, and what the show owns of these.
  bool gas = false;
  const Halo* halo = nullptr;
  const Jet* jet = nullptr;
  double pixel = 0;  // of a draft (radians), in the frame of the lens
  PerSky<Sky> sky;   // all false for a sky that the observer's region does not see

  const Sky& operator[](SkyRegion which) const { return sky[which]; }
  bool has_background() const;
  WantedSkies wanted() const;  // by the frame's lens
};

// Makes the plan from the observer's region, the show's skies and the gains at this instant,
// without loading anything.
FramePlan plan_frame(const Show& show, const FrameState& state);

}  // namespace domefall
