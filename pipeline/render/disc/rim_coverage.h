// How much of a pixel lies on the one side of a rim.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/simd/vector_math.h"

namespace domefall {

// How far a rim is felt, in pixels.
inline constexpr double kRimReach = 0.75;

// The part of a pixel on the greater side of a rim, from the distance to it in pixels.  It goes
// from 0 to 1 a little more slowly than the pixel's square would, so that slanted rims look
// straight.
inline double beyond_rim(double distance) {
  const double x = std::clamp(distance / (2 * kRimReach) + 0.5, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

// The inverse, for parts from 0 to 1: x = 1/2 - sin(asin(1 - 2 part)/3).
inline double distance_to_rim(double part) {
  if (part <= 0 || part >= 1) return part <= 0 ? -kRimReach : kRimReach;
  if (part == 0.5) return 0;  // the middle of nearly all pixels
  const double sine = 1 - 2 * part, cosine = 2 * std::sqrt(part * (1 - part));
  return -2 * kRimReach * sin_cos(arc_tangent2(sine, cosine) / 3).sine;
}

}  // namespace domefall
