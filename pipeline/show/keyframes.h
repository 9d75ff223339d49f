// The lists `keyframes`, of the show and of a segment, and how they are laid over what stays.
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

// `start`: the show's seconds that at_s counts from.  `latest`: the largest at_s allowed.  Names that
// keyframes bear are entered into `camera`.
std::vector<Keyframe> read_keyframes(const Item& item, double start, double latest,
                                     ShowCamera& camera, Lookup& lookup);

// The curve of a channel through those keyframes that give it, nothing if none does.  It begins at
// `start` with the value that is there without them, unless a keyframe stands there.
std::optional<Curve> curve_through(const std::vector<Keyframe>& keyframes, Channel channel,
                                   double start, double value_there);
std::vector<AttitudeKey> attitudes_through(const std::vector<Keyframe>& keyframes, double start,
                                           const Attitude& attitude_there);

}  // namespace domefall
