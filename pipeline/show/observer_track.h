// Where the observer is, and how it moves, along the timeline.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Proper time of a segment's trajectory when `part` of its duration, 0 to 1, has passed.
double proper_time_at(const Segment& segment, double part);

// The observer's state without a camera (tetrad_from_camera is the identity).  Places join: the axes
// on the sky and the null time run on from segment to segment.
// `part` of the segment's duration, 0 to 1, has passed.
ObserverState observer_at(const Show& show, int segment, double part);

// Of a frame: durations such as 0.1 s add up to a little more than the instant they mean, and the
// frame at a cut belongs to what follows it.
inline constexpr double kCutTolerance = 1e-6;  // frames

// The segment seen at an instant; during a dissolve the later one.
int segment_at(const Show& show, double show_time_s);

// How much of a segment has passed, 0 to 1.
double part_at(const Show& show, int segment, double show_time_s);

}  // namespace domefall
