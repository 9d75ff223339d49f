// A StaticObserver is held at constant r, outside the horizon or, in region V, inside an inner one.  In
// flat space it is an observer at rest.
#pragma once

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/orbit_point.h"

namespace domefall {

struct StaticObserver {
  double r = kFlatSpace;  // where spacetime.lapse_squared(r) > 0
  Spacetime spacetime = Schwarzschild{};

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
  static bool is_at_rest(const Spacetime&) { return true; }
};

// Returns the celerity of what is at rest near a Schwarzschild hole, for r != 2 (observer_state.h).  d/dt
// is T + s R in rain and T - s R in the outgoing frame, with s = sqrt(2/r).
Celerity<ReferenceTetrad> resting_celerity(double r, Tetrad tetrad = Tetrad::kRain);

}  // namespace domefall
