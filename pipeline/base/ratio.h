// Ratios as two small whole numbers, for formats that hold them so.
#pragma once

#include <cmath>
#include <string>

namespace domefall {

struct Ratio {
  int over, under;
};

// Returns the ratio of the smallest numbers, up to 2000, that is a value from 0.5 to 2, to its
// rounding, or else the nearest one with the denominator 1000.
inline Ratio ratio_of(double value) {
  constexpr int kMost = 1000;
  constexpr double kSame = 1e-9;
  for (int under = 1; under < kMost; ++under)
    if (const double over = std::round(value * under); std::abs(over - value * under) < kSame)
      return {static_cast<int>(over), under};
  return {static_cast<int>(std::lround(value * kMost)), kMost};
}

// Returns "16:11".
inline std::string ratio_text(double value) {
  const Ratio ratio = ratio_of(value);
  return std::to_string(ratio.over) + ":" + std::to_string(ratio.under);
}

}  // namespace domefall
