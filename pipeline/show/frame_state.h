// One frame of a show: what the renderer needs, a pure function of show and frame number.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct FrameState {
  int frame = 0;
  double show_time_s = 0;
  int segment = 0;  // index into the timeline
  ObserverState observer;
  Projection projection;
};

// frame in [0, frame_count(show)).  Frame n shows the instant n / frames_per_second; azimuth runs on
// from segment to segment.
FrameState frame_state(const Show& show, int frame);

// The camera axes (columns X, Y, Z in the boosted tetrad) for an observer that is otherwise
// complete.  A flat projection puts the target in the middle; a Domemaster puts it `elevation` above
// the front of the rim.
M33d camera_axes(const Camera& camera, const Projection& projection, const ObserverState& observer);

// Where the target appears to the observer, in the boosted tetrad; nothing for Euler angles.
std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& observer);

// The direction (boosted tetrad) in which an observer moves against the static frame, continued
// through the horizon: minus the part of the Killing vector d/dt that is orthogonal to u.  Zero
// length if the observer is static.
V3d motion_direction(const ObserverState& observer);

}  // namespace domefall
