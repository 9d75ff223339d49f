// This law says how proper time passes between two given rates.
#pragma once

namespace domefall {

// Returns the part of a segment's proper time that has passed when the part x (0 to 1) of its
// duration has.  `begin` and `end` (>= 0) are the clock's rates at both ends, as parts of the mean
// rate, which is 1.  The rate is smooth and at no time negative.  Its slope is 0 at both ends, so
// that segments whose rates meet join without a jerk.
//
// With begin + end = 2 the rate goes from the one to the other by 3 x^2 - 2 x^3.  With less,
// 30 x^2 (1 - x)^2, which is the rate from standstill to standstill, is added until the mean is 1.
// With more, the rate leaves `begin` for half the mean and goes on from there to `end`, the faster
// the more both together exceed twice the mean.  It lies within these three values throughout.
//
// Next to x = 0 the result is right to a few epsilon of itself.  1 minus the result is
// part_passed(end, begin, 1 - x).
double part_passed(double begin, double end, double x);

}  // namespace domefall
