// One frame of a show: what the renderer needs, a pure function of show and frame number.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// What keyframes may have changed of exposure and skies, at one instant.
struct FrameSettings {
  struct Sky {
    double background_gain = 1, star_gain = 1;
    double max_magnitude = 6.5;
    // The limit is keyframed: stars fade in over the last half magnitude before it, so that none
    // pops up.  Else all up to it are whole.
    bool soft_limit = false;
  };
  double ev = 0;
  PerSky<Sky> sky;  // region IV has no stars
};

struct FrameState {
  int frame = 0;
  double show_time_s = 0;
  int segment = 0;  // index into the timeline; during a dissolve the later one
  ObserverState observer;
  Projection projection;
  FrameSettings settings;
  // During a dissolve the segment that vanishes, and the part it still has of the light.
  std::shared_ptr<const FrameState> vanishing;
  double vanishing_part = 0;
};

// frame in [0, frame_count(show)).  Frame n shows the instant n / frames_per_second.
FrameState frame_state(const Show& show, int frame);

// The states in the middles of `count` (>= 1) equal parts of the time for which a frame's shutter is open.
// That time ends where the frame's segment does: a cut is not blurred.
std::vector<FrameState> exposure_states(const Show& show, int frame, int count);

// Gives `other` the columns and rows of `state`'s picture, which a caller may have changed, but not its
// field of view.
void take_size(const FrameState& state, FrameState& other);

}  // namespace domefall
