// The texels of sky maps: four half floats.
#pragma once

#include <cstdint>

namespace domefall {

// The channels are IEEE binary16 numbers.  None is negative, infinite, NaN or subnormal.
struct SkyTexel {
  std::uint16_t channel[4];
};

// Returns the half nearest to a value from 0 to 65504; 0 where that would be subnormal (below
// 2^-14).
std::uint16_t half_bits(float value);
float half_value(std::uint16_t bits);

}  // namespace domefall
