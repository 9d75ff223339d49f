// The greatest of many 16-bit values, by which a black frame is known.
#pragma once

#include <cstddef>

namespace domefall {

// Of `count` values; 0 of none.
unsigned short greatest_value(const unsigned short* values, std::size_t count);

// Of half floats without their signs, whose bits are ordered as they are; infinities and NaNs come
// last, 0x7c00 and above.
unsigned short greatest_magnitude(const unsigned short* halves, std::size_t count);

}  // namespace domefall
