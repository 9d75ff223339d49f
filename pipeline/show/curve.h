// A number that changes along the show: keyframes and what lies between them.
#pragma once

#include <vector>

namespace domefall {

// How the stretch that ends at a keyframe is run through.
enum class Ease {
  kSmooth,  // without a kink, and without passing beyond either end
  kLinear,
  kHold,  // the value before stays until the keyframe, then jumps
};

struct CurveKey {
  double at_s;  // show seconds
  double value;
  Ease ease = Ease::kSmooth;
};

struct Curve {
  std::vector<CurveKey> keys;  // never empty; times ascend strictly
};

// At t seconds of show.  The first key's value before it, the last one's after it.  Smooth stretches are cubic: where two of
// them meet the slope is the harmonic mean of the secants, 0 at a turn (Fritsch and Butland 1984), so
// that the curve is monotone wherever its keys are; at the curve's ends and beside a hold it is 0,
// beside a straight stretch that stretch's.
double value_at(const Curve& curve, double t);

// The largest value it ever has.
double largest(const Curve& curve);

// From 0 to 1 as t does, with first and second derivatives 0 at both ends; t outside [0, 1] is moved
// to the nearer end.
double smooth_step(double t);

}  // namespace domefall
