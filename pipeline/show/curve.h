// How numbers change along a show: curves through keyframes, fades, and the rate of a clock between
// two given ones.
#pragma once

#include <vector>

namespace domefall {

// An Ease says how the value changes in the stretch that ends at a keyframe.
enum class Ease {
  kSmooth,  // monotone and without a kink
  kLinear,
  kHold,      // the value before stays until the keyframe, where it jumps
  kEased,     // from standstill to standstill
  kEasedIn,   // from standstill
  kEasedOut,  // to standstill
};

// Returns the part of the change that has happened when the part x, 0 to 1, of the time between two
// keyframes has passed.  Between two alone, kSmooth goes from standstill to standstill too.
double eased(Ease ease, double x);

struct CurveKey {
  double at_s;  // show seconds
  double value;
  Ease ease = Ease::kSmooth;
};

// A Curve is a number that changes along the show, interpolated between keyframes.
struct Curve {
  std::vector<CurveKey> keys;  // never empty; times ascend strictly
};

// Returns the value at t seconds of show.  Before the first key it is that of the first key, after
// the last key that of the last.  A smooth stretch is a cubic with a slope for each end.  Between
// two smooth stretches the slope is the weighted harmonic mean of their secants, or 0 at an extreme
// (Fritsch and Butland 1984), so that the curve is monotone wherever its keys are.  Beside another
// stretch it is the slope that this one has there, and 0 beside a hold.  At the curve's ends it is
// 0.
double value_at(const Curve& curve, double t);

// Returns the largest value of a curve, which is that of a key, since no stretch leaves the values
// of its ends.
double largest(const Curve& curve);

// Returns 10 t^3 - 15 t^4 + 6 t^5, the polynomial of lowest degree that goes from 0 to 1 as t does,
// with first and second derivatives of 0 at both ends.  A t outside [0, 1] is moved to the nearer
// end.
double smooth_step(double t);

// ---- fades ----

// The light rises from black in the first `in_s` seconds of show, and sinks to it in the last
// `out_s`.
struct Fades {
  double in_s = 0, out_s = 0;
};

// Returns the part of its light, 0 to 1, that something which lasts from `begin` to `end` (seconds)
// has left at t.  The light changes evenly to the eye, which sees a quarter of it as half.
double light_left(const Fades& fades, double begin, double end, double t);

// ---- the rate of a clock ----

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
