// One frame of a show: what the renderer needs, a pure function of show and frame number.
#pragma once

#include <memory>

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// What keyframes may have changed of exposure and skies, at one instant.
struct Picture {
  struct Sky {
    double background_gain = 1, star_gain = 1;
    double max_magnitude = 6.5;
    // The limit is keyframed: stars fade in over the last half magnitude before it, so that none
    // pops up.  Else all up to it are whole.
    bool soft_limit = false;
  };
  double ev = 0;
  Sky sky_one, sky_three, sky_four;  // region IV has no stars
};

struct FrameState {
  int frame = 0;
  double show_time_s = 0;
  int segment = 0;  // index into the timeline; during a dissolve the later one
  ObserverState observer;
  Projection projection;
  Picture picture;
  // During a dissolve the segment that vanishes, and the part it still has of the light.
  std::shared_ptr<const FrameState> vanishing;
  double vanishing_part = 0;
};

// frame in [0, frame_count(show)).  Frame n shows the instant n / frames_per_second.
FrameState frame_state(const Show& show, int frame);

}  // namespace domefall
