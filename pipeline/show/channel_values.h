// The sections `exposure`, `grade` and `sky` of a segment or a keyframe, which name channels.
#pragma once

#include "pipeline/show/channel.h"
#include "pipeline/show/section.h"

namespace domefall {

inline constexpr Range kStops = Range{"stops"}.within(-30, 30);
inline constexpr Range kGain = kPureNumber.within(0, 1e6);
inline constexpr Range kMagnitudes = Range{"magnitudes"}.within(-30, 40);

// Reads `cdl: {slope, offset, power, saturation}` of a section `grade` into the channels of the CDL.
void read_cdl(const Section& grade, ChannelValues& values);

// Reads `exposure: {ev}`, `grade: {cdl}` and `sky: {region_I: {gain, stars: {gain, max_magnitude}}, ...}` of a
// section.  The camera's channels stay empty.  The skies of a segment may also have the keys of
// backgrounds, which read_backgrounds (sky_section.h) reads; `has_backgrounds` says so.
ChannelValues read_values(const Section& section, bool has_backgrounds);

}  // namespace domefall
