// These functions read the sections `exposure`, `grade` and `sky` of a segment or a keyframe, whose
// numbers are channels.
#pragma once

#include "pipeline/show/channel.h"
#include "pipeline/show/section.h"

namespace domefall {

inline constexpr Range kStops = Range{"stops"}.within(-30, 30);
inline constexpr Range kGain = kPureNumber.within(0, 1e6);
inline constexpr Range kMagnitudes = Range{"magnitudes"}.within(-30, 40);

// Reads `cdl: {slope, offset, power, saturation}` of a section `grade` into the CDL's channels.
void read_cdl(const Section& grade, ChannelValues& values);

// Reads these keys of a section, and leaves the camera's channels empty:
//     exposure: {ev}
//     grade: {cdl}
//     sky: {region_I: {gain, stars: {gain, max_magnitude}}, ...}
// With `has_backgrounds`, which holds for segments, skies may also have the keys of backgrounds,
// which read_backgrounds (sky_section.h) reads.
ChannelValues read_values(const Section& section, bool has_backgrounds);

}  // namespace domefall
