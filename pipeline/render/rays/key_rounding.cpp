#include "pipeline/render/rays/key_rounding.h"

#include <cmath>

namespace domefall {

// By Veltkamp's splitting, x (2^12 + 1) - (x (2^12 + 1) - x) is x rounded to 53 - 12 bits.
double rounded_for_key(double value) {
  constexpr double kSplit = 4097;
  const double scaled = kSplit * value, high = scaled - (scaled - value);
  return std::isfinite(high) ? high : value;
}

void add_rotation(Digest& digest, const M33d& m) {
  // Adding 0.0 turns -0 into 0, which has other bits.
  constexpr double kUnitSteps = 1e12;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) digest.add(std::round(m[i][j] * kUnitSteps) + 0.0);
}

}  // namespace domefall
