// Frames per second as a fraction.
#pragma once

namespace domefall {

struct ExactRate {
  int numerator = 30;
  unsigned denominator = 1;
};

// The fraction that a rate stands for: 30000/1001 for 29.97, 24/1 for 24.  The rate is above 0.
ExactRate exact_rate(double frames_per_second);

}  // namespace domefall
