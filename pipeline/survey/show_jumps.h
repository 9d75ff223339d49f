// What an audience would see jump: how segments join, and what changes too fast between frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Where a segment follows another.
struct SegmentJoint {
  int segment = 0;    // the later one
  double time_s = 0;  // show seconds: its beginning
  double dissolve_s = 0;
  double r_before = 0, r_after = 0;  // M
  Region region_before = Region::kI, region_after = Region::kI;
  // Of the two observers against each other (1 is light's); nothing where they are not at one place.
  std::optional<double> speed;
  double rate_before = 0, rate_after = 0;  // M of proper time a second of show

  bool place_jumps() const;
  bool velocity_jumps() const;
};

std::vector<SegmentJoint> segment_joints(const Show& show);

struct ShowWarning {
  double time_s = 0;  // show seconds
  int frame = 0;
  int segment = 0;
  std::string text;
};

// Above these a warning is given.
inline constexpr double kFastestTurnDeg = 30;  // degrees of camera turn per second of show
inline constexpr double kLargestEvStep = 0.5;  // stops between frames
inline constexpr double kLargestRateStep = 2;  // a factor, where nothing else jumps

// In the order of time: a camera that turns faster, against the sky and against the hole (whichever is
// slower: a camera that keeps either in view stands still); exposures that jump; clocks that change their
// rate where a motion goes on; what a keyframe with `ease: hold` changes.  All frames of a show of up to
// 20,000 frames are compared with the next one, of a longer one 20,000; of segments with keyframed
// targets every tenth and those about the keyframes.
std::vector<ShowWarning> show_warnings(const Show& show);

}  // namespace domefall
