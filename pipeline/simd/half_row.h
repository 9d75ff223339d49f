// Conversion of rows of floats to half floats.
#pragma once

#include <cstdint>

namespace domefall {

// Converts `count` floats to the bits of half floats, rounded to nearest with ties to even; values
// above 65504, the largest half, become 65504, and negative ones 0.  Returns whether all values
// were finite; if it is false, `out` holds no meaningful values.  It equals Imath's
// conversion for every half, near every half-way value and for 100,000 others, as a test shows.
bool to_half(const float* values, int count, std::uint16_t* out);

}  // namespace domefall
