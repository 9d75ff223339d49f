// The observer's place and motion along the timeline.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The proper time of a segment's trajectory when `part` of the segment's duration, 0 to 1, has
// passed.  At both ends it is that of the segment's timing.
ProperTime proper_time_at(const Segment& segment, double part);

// What the first segment of a show sets out with, except for its instant.
Joint first_joint(const Show& show, const Segment& first);
// What `segment` hands over at its end, and what `next` makes of it.
Joint joint_after(const Joint& joint, const Segment& segment);
Joint joint_into(const Joint& reached, const Segment& next);

// The v of a joint in region I or II; 0 in the others, which have none.
double rain_time(const Joint& joint);

// Sets the joints of a show, so that a state costs the same in a show of any length.
void join_segments(Show& show);

// The show second at which a segment begins.
double begin_of(const Show& show, int segment);

// The observer's state when `part` of a segment, 0 to 1, has passed.  It has no camera yet:
// tetrad_from_camera is the identity.  The axes on the sky, the azimuth and the null time run on
// from segment to segment.
ObserverState observer_at(const Show& show, int segment, double part);

// In frames.  Durations such as 0.1 s add up to a little more than they mean, and the frame at a
// cut must still belong to the segment that follows it.
inline constexpr double kCutTolerance = 1e-6;

// The index of the segment seen at an instant; during a dissolve that of the later one.
int segment_at(const Show& show, double show_time_s);

// The part of a segment that has passed at an instant, 0 to 1.
double part_at(const Show& show, int segment, double show_time_s);

}  // namespace domefall
