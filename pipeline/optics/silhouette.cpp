#include "pipeline/optics/silhouette.h"

#include <cmath>

namespace domefall {
namespace {

const double kSqrt27 = std::sqrt(27.0);

// (r - 3) sqrt(1 + 6/r), the square root of r^2 - 27 (1 - 2/r) with the sign of r - 3.
double signed_root(const Radius& at) { return at.above_light_circle * std::sqrt(1 + 6 / at.r); }

// 1 - sqrt(2/r) from the altitude.
double one_minus_s(const Radius& at) {
  return at.above_horizon / (at.r * (1 + std::sqrt(2 / at.r)));
}

}  // namespace

double tan_half_silhouette(const Radius& at) {
  if (std::isinf(at.r)) return 0;
  if (at.r > 3) return kSqrt27 * one_minus_s(at) / (at.r + signed_root(at));
  return (at.r - signed_root(at)) / (kSqrt27 * (1 + std::sqrt(2 / at.r)));
}

double tan_half_region_three(const Radius& at) { return -tan_half_other_root(at); }

double tan_half_other_root(const Radius& at) {
  if (at.r < 3) return kSqrt27 * one_minus_s(at) / (at.r - signed_root(at));
  return (at.r + signed_root(at)) / (kSqrt27 * (1 + std::sqrt(2 / at.r)));
}

double silhouette_edge(const Radius& at) { return 2 * std::atan(tan_half_silhouette(at)); }

double region_three_edge(const Radius& at) { return 2 * std::atan(tan_half_region_three(at)); }

}  // namespace domefall
