// These pictures tell an operator whether the dome shows what was made.  They show how it is turned
// and bent, its greys and colours, and which show it is.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "projections/projection.h"

namespace domefall {

// ShowLines are what the pictures say of a show, in a line each, the title first.
using ShowLines = std::vector<std::string>;

// Draws a grid over the whole picture.  A dome has the rim, circles of altitude every 10 degrees
// and lines of azimuth every 15, and FRONT (at the bottom), LEFT, RIGHT and BACK as the audience
// reads them.  A flat picture has its border, frames at 90 and 80 % of its size, and its middle.
// Greys from black to white in equal steps of code, and the primary colours, stand at the front.
GradedFrame alignment_frame(const Projection& projection, const ShowLines& lines);

// A leader runs before the show.  It is a slate for kSlateSeconds, then a number for each second
// that is left.
inline constexpr int kSlateSeconds = 3, kCountdownSeconds = 5;

int leader_frames(double frames_per_second);

// Draws frame k of the leader, from 0.  Everything stands at the front of a dome, around 35 degrees
// of altitude, or in the middle of a flat picture, and the number of the frame below it.
GradedFrame leader_frame(const Projection& projection, const ShowLines& lines,
                         double frames_per_second, int k);

}  // namespace domefall
