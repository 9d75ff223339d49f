// What a segment or a keyframe may say of exposure and skies, besides its camera.
#pragma once

#include <array>

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// By Channel; of the camera's channels none.
using ChannelValues = std::array<std::optional<double>, kChannels>;

// The sections `exposure: {ev}` and `sky: {region_I: {gain, stars: {max_magnitude, gain}}, ...}`.
ChannelValues read_values(const Section& section);

inline constexpr Range kStops = Range{"stops"}.within(-30, 30);
inline constexpr Range kGain = kPureNumber.within(0, 1e6);
inline constexpr Range kMagnitudes = Range{"magnitudes"}.within(-30, 40);

}  // namespace domefall
