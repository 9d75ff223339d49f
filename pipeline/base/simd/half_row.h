// to_half() converts rows of floats to half floats.
#pragma once

#include <cstdint>

namespace domefall {

// Converts `count` floats to the bits of half floats, rounded to nearest with ties to even.  Values
// above 65504, the largest half, become 65504, and negative ones become 0.  Returns whether all
// values were finite.  If not, `out` holds no meaningful values.  The conversion equals Imath's for
// every half, near every half-way value and for 100,000 others, as a test shows.
bool to_half(const float* values, int count, std::uint16_t* out);

}  // namespace domefall
