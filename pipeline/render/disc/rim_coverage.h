// How much of a pixel lies on the one side of a rim.
#pragma once

#include <algorithm>
#include <cmath>

namespace domefall {

// A pixel sees a rim by a weight that is 1 next to its middle and falls evenly to 0 at kRimReach:
// the mean of a square's chords, on the one hand along the rows and on the other along the
// diagonals.  So a line that is narrower than a pixel has the same light wherever it lies between
// two rows, or between two diagonals.
inline constexpr double kRimDiagonal = 0.70710678118654752440;
inline constexpr double kRimEven = (1 - kRimDiagonal) / 2, kRimReach = (1 + kRimDiagonal) / 2;

// The part of a pixel on the greater side of a rim, from the distance to it in pixels.
inline double beyond_rim(double distance) {
  const double off = std::abs(distance), rest = std::max(0.0, kRimReach - off);
  const double more = off < kRimEven ? 0.5 + off : 1 - rest * rest * kRimDiagonal;
  return distance < 0 ? 1 - more : more;
}

// The inverse, for parts from 0 to 1.
inline double distance_to_rim(double part) {
  const double less = std::min(part, 1 - part);
  const double off = less > 0.5 - kRimEven
                         ? 0.5 - less
                         : kRimReach - std::sqrt(std::max(0.0, less) / kRimDiagonal);
  return part < 0.5 ? -off : off;
}

}  // namespace domefall
