// Where the camera looks along the timeline.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The axes that the camera of a segment has t seconds into the show, for a picture of that projection.
// Between keyframes it turns about one axis at a time, so that it never jumps however the targets
// move meanwhile.
M33d camera_axes_at(const Show& show, int segment, double t, const Projection& projection,
                    const ObserverState& observer);

// Fills in AttitudeKey::turns of a show that is otherwise complete, some milliseconds for each that
// looks at the sky.
void follow_turns(Show& show);

}  // namespace domefall
