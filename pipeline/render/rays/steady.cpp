#include "pipeline/render/rays/steady.h"

#include <cmath>

namespace domefall {

// Veltkamp's splitting: multiplied by 2^12 + 1 and subtracted from itself, a number loses its last
// 12 bits by rounding.
double steady(double value) {
  constexpr double kSplit = 4097;
  const double scaled = kSplit * value, high = scaled - (scaled - value);
  return std::isfinite(high) ? high : value;
}

void add_rotation(Digest& digest, const M33d& m) {
  constexpr double kUnitSteps = 1e12;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) digest.add(std::round(m[i][j] * kUnitSteps) + 0.0);
}

}  // namespace domefall
