// A Curve is a number that changes along the show, interpolated between keyframes.
#pragma once

#include <vector>

namespace domefall {

// An Ease says how the value changes in the stretch that ends at a keyframe.
enum class Ease {
  kSmooth,  // monotone and without a kink
  kLinear,
  kHold,  // the value before stays until the keyframe, where it jumps
};

struct CurveKey {
  double at_s;  // show seconds
  double value;
  Ease ease = Ease::kSmooth;
};

struct Curve {
  std::vector<CurveKey> keys;  // never empty; times ascend strictly
};

// Returns the value at t seconds of show.  Before the first key it is that of the first key, after
// the last key that of the last.  A smooth stretch is a cubic with a slope for each end.  Between
// two smooth stretches the slope is the weighted harmonic mean of their secants, or 0 at an extreme
// (Fritsch and Butland 1984), so that the curve is monotone wherever its keys are.  Beside a linear
// stretch it is the slope of the line.  At the curve's ends and beside a hold it is 0.
double value_at(const Curve& curve, double t);

// Returns the largest value of a curve, which is that of a key, since no stretch leaves the values
// of its ends.
double largest(const Curve& curve);

// Returns 10 t^3 - 15 t^4 + 6 t^5, the polynomial of lowest degree that goes from 0 to 1 as t does,
// with first and second derivatives of 0 at both ends.  A t outside [0, 1] is moved to the nearer
// end.
double smooth_step(double t);

}  // namespace domefall
