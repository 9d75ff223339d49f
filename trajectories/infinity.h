// Infinity is the proper time of what never ends, and the far end of an orbit that is not bound.
#pragma once

#include <limits>

namespace domefall {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace domefall
