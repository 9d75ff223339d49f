// What an audience would see jump: the joints of segments, and what changes too fast between
// frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"

namespace domefall {

// The instant at which a segment follows another, as both have it.
struct SegmentJoint {
  int segment = 0;    // the later one
  double time_s = 0;  // show seconds at which it begins
  double dissolve_s = 0;
  double r_before = 0, r_after = 0;  // M
  Region region_before = Region::kI, region_after = Region::kI;
  // The observers' speed against each other (1 is light's).  There is none unless they are at one
  // place.
  std::optional<double> speed;
  double rate_before = 0, rate_after = 0;  // M of proper time a second of show

  // By another region, or by more than 1e-6 of r.
  bool place_jumps() const;
  // By more than 1e-4 of light's speed.
  bool velocity_jumps() const;
};

// One for each segment but the first.
std::vector<SegmentJoint> segment_joints(const Show& show);

inline constexpr int kWholeShow = -1;
struct ShowWarning {
  double time_s = 0;  // show seconds
  int frame = 0;
  int segment = 0;  // kWholeShow: it is of no place
  std::string text;
};

// A warning is given for what exceeds these.
inline constexpr double kFastestTurnDeg = 30;  // degrees of camera turn per second of show
inline constexpr double kLargestEvStep = 0.5;  // stops between frames
inline constexpr double kLargestRateStep = 2;  // a factor between clocks, where nothing else jumps

// The warnings of a show, in the order of time.  They are about
// - a camera that turns too fast.  Its turn is taken against the sky and against the hole, and the
//   smaller of the two counts, since a camera that keeps either in view stands still;
// - an exposure that jumps from one frame to the next;
// - a clock that changes its rate where the motion goes on;
// - what a keyframe with `ease: hold` changes.
// Every frame of a show of up to 20,000 frames is compared with the one before, and 20,000 frames
// of a longer one.  In segments with keyframed targets only every tenth frame is compared, and
// those within two frames of a keyframe.
std::vector<ShowWarning> show_warnings(const Show& show);

}  // namespace domefall
