// These functions say how much of a pixel lies on one side of a rim.
#pragma once

#include <algorithm>
#include <cmath>

namespace domefall {

// A pixel weights the light of a line by the distance to it.  The weight is 1 up to kRimEven and
// falls linearly to 0 at kRimReach.  It is the convolution of two boxes, one as wide as the
// distance 1 between rows of pixels and one as wide as the distance 1/sqrt 2 between diagonals.  So
// the weights of all rows add up to a constant, and those of all diagonals too.  A line narrower
// than a pixel therefore has the same light wherever it lies between two rows or two diagonals.
inline constexpr double kRimDiagonal = 0.70710678118654752440;
inline constexpr double kRimEven = (1 - kRimDiagonal) / 2, kRimReach = (1 + kRimDiagonal) / 2;

// Returns the part of a pixel on the greater side of a rim, from the signed distance to it in
// pixels.  This is the integral of the weight.
inline double beyond_rim(double distance) {
  const double off = std::abs(distance), rest = std::max(0.0, kRimReach - off);
  const double more = off < kRimEven ? 0.5 + off : 1 - rest * rest * kRimDiagonal;
  return distance < 0 ? 1 - more : more;
}

// Returns 1, or near the middle of the hole the factor from the difference between the labels of a pixel
// and a rim, in units of the label's change across the pixel, to their distance in pixels.  A label is
// much like the cotangent of the angle from the hole over the observer's r, so that in the pixels of the
// middle it changes by as much as itself, and a rim far away would seem to be next to them.  Elsewhere
// nothing may bend the weights, which add up to a constant.
inline double label_bend(double label, double rim, double r) {
  constexpr double kFar = 3;
  const double a = label * r, b = rim * r, bend2 = (1 + a * a) / (1 + b * b);
  return bend2 > kFar * kFar ? std::sqrt(bend2) : 1;
}

// Inverts beyond_rim() for parts from 0 to 1.
inline double distance_to_rim(double part) {
  const double less = std::min(part, 1 - part);
  const double off = less > 0.5 - kRimEven
                         ? 0.5 - less
                         : kRimReach - std::sqrt(std::max(0.0, less) / kRimDiagonal);
  return part < 0.5 ? -off : off;
}

}  // namespace domefall
