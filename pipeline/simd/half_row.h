// Rows of floats as half floats.
#pragma once

#include <cstdint>

namespace domefall {

// Rounded to nearest, ties to even; more than 65504 becomes that.  Values are >= 0 (or tiny below).
// Whether all were finite; if not, what stands in `out` is of no use.
bool to_half(const float* values, int count, std::uint16_t* out);

}  // namespace domefall
