// These functions read the lists `keyframes` of a show and of its segments, and lay curves through
// them.
#pragma once

#include <vector>

#include "pipeline/show/camera_section.h"
#include "pipeline/show/channel_values.h"

namespace domefall {

struct Keyframe {
  double at_s = 0;  // show seconds
  Ease ease = Ease::kSmooth;
  std::optional<Attitude> attitude;
  ChannelValues values;
};

// A KeyframeSpan is the part of the show for which a list of keyframes is given.
struct KeyframeSpan {
  double start = 0;   // the show's second from which at_s counts
  double latest = 0;  // the largest at_s allowed
};

// Reads a list of keyframes, whose times must ascend.  Keyframes that bear a name are entered into
// `camera`.
std::vector<Keyframe> read_keyframes(const Item& item, const KeyframeSpan& span,
                                     const std::vector<Marker>& markers, ShowCamera& camera,
                                     Lookup& lookup);

// Returns the curve of a channel through the keyframes that give it, or nothing if none does.  The
// curve begins at `start` with `value_there`, the value without keyframes, unless a keyframe stands
// there.
std::optional<Curve> curve_through(const std::vector<Keyframe>& keyframes, Channel channel,
                                   double start, double value_there);
// Returns the attitudes of the keyframes that give one, which begin in the same way with
// `attitude_there`.  The list is empty if no keyframe gives one.
std::vector<AttitudeKey> attitudes_through(const std::vector<Keyframe>& keyframes, double start,
                                           const Attitude& attitude_there);

}  // namespace domefall
