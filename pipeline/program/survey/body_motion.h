// Bodies may move too fast to be followed, and one straight behind the hole may flash.
#pragma once

#include <vector>

#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/show/show.h"

namespace domefall {

// A warning is given for a body that moves from frame to frame by more than this part of the
// picture's width while the shutter is closed: on a dome by two degrees, 60 a second at 30 frames.
inline constexpr double kFastestBody = 1.0 / 90;
// A flash is a frame with more than this many times the light of both of its neighbours.
inline constexpr double kFlash = 3;

// Returns a warning for each body and segment in which its direct image, while it is in the picture
// and bright enough to be seen, moves so far, at the frame where it moves farthest; and one if it
// passes behind the hole so fast that its light there is in one frame alone.  8 such passages are
// looked at.  Frames next to each other are
// compared: all of them where bodies times frames are 5000 at most and no camera is keyframed, and
// otherwise every few frames.  It takes some 0.1 ms for each body and pair of frames.
std::vector<ShowWarning> body_warnings(const Show& show);

}  // namespace domefall
