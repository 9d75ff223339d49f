#include "trajectories/static_observer.h"

#include <cmath>

namespace domefall {

V3d static_celerity(double r) { return {std::sqrt(2 / (r - 2)), 0, 0}; }

OrbitPoint point_at(const StaticObserver& observer, double /*tau*/) {
  return {Region::kI, observer.r, 0, static_celerity(observer.r)};
}

}  // namespace domefall
