#include "trajectories/static_observer.h"

#include <cmath>

namespace domefall {

V3d resting_celerity(double r, Tetrad tetrad) {
  const double celerity = r > 2 ? std::sqrt(2 / (r - 2)) : std::sqrt(r / (2 - r));
  return {is_outgoing(tetrad) ? -celerity : celerity, 0, 0};
}

OrbitPoint point_at(const StaticObserver& observer, double tau) {
  return {Region::kI,
          Tetrad::kRain,
          observer.r,
          0,
          resting_celerity(observer.r),
          tau / std::sqrt(1 - 2 / observer.r)};
}

}  // namespace domefall
