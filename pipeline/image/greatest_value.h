// A black frame is known by the greatest of many 16-bit values.
#pragma once

#include <cstddef>

namespace domefall {

// Returns the greatest of `count` values, or 0 of none.
unsigned short greatest_value(const unsigned short* values, std::size_t count);

// Returns the greatest of half floats without their signs, whose bits are ordered as they are.
// Infinities and NaNs come last, at 0x7c00 and above.
unsigned short greatest_magnitude(const unsigned short* halves, std::size_t count);

}  // namespace domefall
