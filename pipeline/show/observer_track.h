// These functions give the place and motion of the observer, and the orientation of the camera, along
// the timeline.
#pragma once

#include "pipeline/show/show.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Returns the proper time of a segment's trajectory when `part` of the segment's duration, 0 to 1,
// has passed.  At both ends it is that of the segment's timing.
ProperTime proper_time_at(const Segment& segment, double part);

// Returns the joint with which the first segment of a show sets out.  Here and in the next two
// functions its begin_s is left to join_segments().
Joint first_joint(const Show& show, const Segment& first);
// Returns the joint that `segment` hands over at its end.
Joint joint_after(const Joint& joint, const Segment& segment);
// Returns the joint with which `next` begins, which may have a beginning of its own.
Joint joint_into(const Joint& reached, const Segment& next);

// Returns the v of a joint in region I or II, or 0 in the other regions, which have none.
double rain_time(const Joint& joint);

// Sets the joints of a show, so that a state takes the same time to compute in a show of any
// length.
void join_segments(Show& show);

// Returns the show second at which a segment begins.
double begin_of(const Show& show, int segment);

// Returns the observer's state when `part` of a segment, 0 to 1, has passed.  It has no camera yet,
// so that tetrad_from_camera is the identity.  The axes on the sky, the azimuth and the null time
// run on from segment to segment.
ObserverState observer_at(const Show& show, int segment, double part);

// A frame that lies at most this many frames before a cut belongs to the segment after the cut.
// Durations such as 0.1 s add up to a little more than they mean, and the frame at a cut must still
// belong to the segment that follows it.
inline constexpr double kCutTolerance = 1e-6;

// Returns the index of the segment seen at an instant, which is the later one during a dissolve.
int segment_at(const Show& show, double show_time_s);

// Returns the part of a segment that has passed at an instant, 0 to 1.
double part_at(const Show& show, int segment, double show_time_s);

// ---- the camera ----

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
