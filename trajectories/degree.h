// This is one degree in radians, the unit of angles everywhere inside.
#pragma once

#include <numbers>

namespace domefall {

inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace domefall
