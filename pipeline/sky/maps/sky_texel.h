// A texel of a sky map holds four half floats.
#pragma once

#include <cstdint>

namespace domefall {

// The channels are IEEE binary16 numbers.  None is negative, infinite, NaN or subnormal.
struct SkyTexel {
  std::uint16_t channel[4];
};

// Returns the half that is nearest to a value from 0 to 65504.  It is 0 where that half would be
// subnormal (below 2^-14).
std::uint16_t half_bits(float value);
float half_value(std::uint16_t bits);

}  // namespace domefall
