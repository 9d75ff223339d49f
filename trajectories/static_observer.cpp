#include "trajectories/static_observer.h"

#include <cmath>

#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

Celerity<ReferenceTetrad> resting_celerity(double r, Tetrad tetrad) {
  return resting_celerity(Schwarzschild{}, r, tetrad);
}

OrbitPoint StaticObserver::at(const ProperTime& tau) const {
  return {r < spacetime.inner_horizon() ? Region::kV : Region::kI,
          Tetrad::kRain,
          r,
          0,
          resting_celerity(spacetime, r, Tetrad::kRain),
          double(tau) / std::sqrt(spacetime.lapse_squared(r))};
}

}  // namespace domefall
