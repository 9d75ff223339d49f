#include "pipeline/spacetime/schwarzschild.h"

#include <boost/math/special_functions/log1p.hpp>

namespace domefall {

double Schwarzschild::tortoise(const Radius& at) {
  if (at.r < 1) return 2 * boost::math::log1pmx(-at.r / 2);  // 2 [ln(1 - r/2) + r/2]
  return at.r + 2 * std::log(std::abs(at.above_horizon) / 2);
}

}  // namespace domefall
