// These functions give the camera's orientation along the timeline.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Returns the axes (columns in the boosted tetrad of the observer) that the camera of a segment has
// t seconds into the show, for an image of that projection.  Between two keyframes the camera has
// turned by a part of the rotation that leads from the one attitude to the other at t, so that it
// does not jump while targets move.
M33d camera_axes_at(const Show& show, int segment, double t, const Projection& projection,
                    const ObserverState& observer);

// Fills in AttitudeKey::turns of a show that is otherwise complete.  This takes some milliseconds
// for each keyframe with a target on the sky.
void follow_turns(Show& show);

}  // namespace domefall
