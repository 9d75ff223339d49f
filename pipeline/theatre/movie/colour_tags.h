// The colour tags of a video are code points of ITU-T H.273, by which a player knows what its codes
// mean.
#pragma once

#include <optional>
#include <string>

#include "pipeline/image/encode/display_colour.h"

namespace domefall {

struct ColourTags {
  int primaries = 2, transfer = 2;  // 2 is unspecified
  int matrix = 1;                   // by which RGB becomes YCbCr: 1 is BT.709's, 9 that of BT.2020

  bool operator==(const ColourTags&) const = default;
};

// Returns the tags of codes for such a display, or for one that is not known.  A curve or primaries
// that H.273 has no code point for, such as the power 2.6, are unspecified.  Primaries match within
// 0.001 in x and y, and powers within 0.01.  Those of DCI-P3 also match with a white that was
// adapted to D65.
ColourTags tags_of(const std::optional<DisplayColour>& display);

// Says for people "primaries bt709, transfer iec61966-2-1 (sRGB), matrix bt709", for example.
std::string describe(const ColourTags& tags);

}  // namespace domefall
