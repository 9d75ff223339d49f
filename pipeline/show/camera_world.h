// The camera of a show as programs for three dimensions know it.
//
// Their world is what surrounds the observer, with axes that are at right angles in the observer's
// own frame: x is Phi, the way on which an orbit goes, y is -Theta, its north, and z is R, away
// from the hole, as the observer's motion against the tetrad shows them (base_axes() of attitude.h).  A
// camera looks along its own -z, with x to the right and y up in the picture.  So one that is not
// turned looks at the hole, but for the aberration of a motion across, with the north above.  A dome's camera looks at the middle of the
// picture, the zenith, with the back of the dome above.
#pragma once

#include "pipeline/show/frame_state.h"

namespace domefall {

// These return a rotation whose columns are the directions x, y and z of the camera, or the right,
// the zenith and the back of the audience, in that world.
M33d world_from_camera(const ObserverState& observer, const Projection& projection);
M33d world_from_audience(const FrameState& state);

// Returns the axes of a camera that is turned so, along those of base_axes() (attitude.h).
M33d base_from_camera(const M33d& world_from_camera, const Projection& projection);

}  // namespace domefall
