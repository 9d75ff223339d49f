#include "pipeline/spacetime/wormhole.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

}  // namespace

double flare(double x) { return x * std::atan(x) - std::log1p(x * x) / 2; }

double flare_growth(double low, double more) {
  const double high = low + more;
  return more * std::atan(high) + low * std::atan(more / (1 + low * high)) -
         std::log1p(more * (low + high) / (1 + low * low)) / 2;
}

// G is convex, so that Newton's steps come down to the root after the first of them.
double flare_inverse(double value) {
  double x = value < 1 ? std::sqrt(2 * value) : 2 / pi * value + 1;
  for (int k = 0; k < 60 && x > 0; ++k) {
    const double step = (flare(x) - value) / std::atan(x);
    x -= step;
    if (std::abs(step) <= std::numeric_limits<double>::epsilon() * x) break;
  }
  return x;
}

double Wormhole::beyond_mouth(double l) const { return std::max(0.0, std::abs(l) - half_length()); }

double Wormhole::above_throat(double l) const {
  if (profile == Profile::kEllis) {
    const double far = std::abs(l);
    return far > 1 ? std::hypot(1, far) - 1 : far * far / (1 + std::hypot(1, far));
  }
  const double m = lensing_mass();
  return m * flare(2 / pi * beyond_mouth(l) / m);
}

double Wormhole::slope(double l) const {
  if (profile == Profile::kEllis) return l / std::hypot(1, l);
  return std::copysign(2 / pi * std::atan(2 / pi * beyond_mouth(l) / lensing_mass()), l);
}

double Wormhole::curvature(double l) const {
  return in_cylinder(l) ? 0 : curvature_beyond(beyond_mouth(l));
}

double Wormhole::curvature_beyond(double y) const {
  if (profile == Profile::kEllis) return std::pow(std::hypot(1, y), -3);
  const double x = 2 / pi * y / lensing_mass();
  return curvature_at_throat() / (1 + x * x);
}

double Wormhole::curvature_at_throat() const {
  return profile == Profile::kEllis ? 1 : 4 / (pi * pi * lensing_mass());
}

double Wormhole::distance(double above_throat) const {
  if (profile == Profile::kEllis) return std::sqrt(above_throat) * std::sqrt(2 + above_throat);
  const double m = lensing_mass();
  return half_length() + pi / 2 * m * flare_inverse(above_throat / m);
}

std::vector<double> Wormhole::parameters() const {
  if (profile == Profile::kEllis) return {0};
  return {1, length, lensing_width};
}

}  // namespace domefall
