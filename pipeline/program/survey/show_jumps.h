// An audience would see jumps at the joints of segments, and where something changes too fast
// between frames.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/program/survey/show_survey.h"
#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// A joint is the instant at which a segment follows another, with the state that each of them gives
// it.
struct SegmentJoint {
  int segment = 0;    // the later one
  double time_s = 0;  // show seconds at which it begins
  double dissolve_s = 0;
  double r_before = 0, r_after = 0;  // M
  Visit before, after;
  // The observers have this speed against each other (1 is light's).  It is missing unless they are
  // at one place.
  std::optional<double> speed;
  double rate_before = 0, rate_after = 0;  // M of proper time a second of show

  // Says whether the place jumps to another region, but through a horizon, or by more than 1e-6 of r.
  bool place_jumps() const;
  // Says whether the velocity jumps by more than 1e-4 of light's speed.
  bool velocity_jumps() const;
};

// Returns one joint for each segment but the first.
std::vector<SegmentJoint> segment_joints(const Show& show);

// A warning is given for changes that exceed these limits.
inline constexpr double kFastestTurnDeg = 30;  // degrees of camera turn per second of show
inline constexpr double kFastestGasDeg = 20;   // degrees of a disc's inner gas between frames
inline constexpr double kLargestEvStep = 0.5;  // stops between frames
inline constexpr double kLargestRateStep = 2;  // a factor between clocks, where nothing else jumps

// Returns the warnings of a show's jumps, in the order of time.  They are about
// - a camera that turns too fast.  Its turn is taken against the sky and against the hole, and the
//   smaller of the two counts, since a camera that keeps either in view stands still;
// - an exposure that jumps from one frame to the next;
// - a disc whose pattern turns too fast to be followed;
// - a clock that changes its rate where the motion goes on;
// - what a keyframe with `ease: hold` changes.
// In a show of up to 20,000 frames every frame is compared with the one before.  In a longer show
// this is done for 20,000 frames.  In segments with keyframed targets only every tenth frame is
// compared, and those within two frames of a keyframe.
std::vector<ShowWarning> jump_warnings(const Show& show);

}  // namespace domefall
