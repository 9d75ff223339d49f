// A number that changes along the show, interpolated between keyframes.
#pragma once

#include <vector>

namespace domefall {

// How the stretch that ends at a keyframe is run through.
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

// The value at t seconds of show.  Before the first key it is that key's, after the last one that
// one's.  A smooth stretch is a cubic with a slope for each end.  Between two smooth stretches the
// slope is the weighted harmonic mean of their secants, or 0 at an extreme (Fritsch and Butland
// 1984), so that the curve is monotone wherever its keys are.  Beside a straight stretch it is that
// stretch's, and at the curve's ends and beside a hold it is 0.
double value_at(const Curve& curve, double t);

// The largest value that a curve has.
double largest(const Curve& curve);

// 10 t^3 - 15 t^4 + 6 t^5, which goes from 0 to 1 as t does, with first and second derivatives of 0
// at both ends.  A t outside [0, 1] is moved to the nearer end.
double smooth_step(double t);

}  // namespace domefall
