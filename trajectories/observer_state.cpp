#include "trajectories/observer_state.h"

#include <cmath>

namespace domefall {

M33d sky_axes(const ObserverState& o, SkyRegion sky) {
  if (sky != SkyRegion::kIII || !o.spacetime.is<Wormhole>()) return o.sky_from_tetrad;
  const V3d& mouth = o.mouth_at_start;
  const auto mirrored = [&](int k) {
    const V3d axis = column(o.sky_from_tetrad, k);
    return axis - mouth * (2 * mouth.dot(axis));
  };
  return from_columns(mirrored(0), mirrored(1), mirrored(2));
}

Celerity<ReferenceTetrad> resting_celerity(const Spacetime& spacetime, double r, Tetrad tetrad) {
  const double celerity = spacetime.resting_celerity(r);
  return {is_outgoing(tetrad) ? -celerity : celerity, 0, 0};
}

double radial_rate(const Spacetime& spacetime, double r, Tetrad tetrad,
                   const Celerity<ReferenceTetrad>& celerity) {
  const StaticTime t = spacetime.static_time(r);
  const double inward = t.along_r * gamma_of(celerity);
  return t.along_t * celerity.x + (is_outgoing(tetrad) ? inward : -inward);
}

Celerity<RestFrame> static_celerity(const ObserverState& o) {
  // For the observer at rest dr is the length dr/sqrt(f).
  const double rate = radial_rate(o.spacetime, o.r, o.tetrad, o.celerity);
  return {rate / std::sqrt(o.spacetime.lapse_squared(o.r)), o.celerity.y, o.celerity.z};
}

// E and dr/dtau in the outgoing tetrad give w in rain, with f = along_t^2 - along_r^2.
Celerity<RainTetrad> rain_celerity(const Spacetime& spacetime, double r, Tetrad tetrad,
                                   const Celerity<ReferenceTetrad>& celerity) {
  if (!is_outgoing(tetrad)) return Celerity<RainTetrad>(celerity);
  const auto [t, s] = spacetime.static_time(r);
  const double below = (t - s) * (t + s);
  return {((t * t + s * s) * celerity.x + 2 * s * t * gamma_of(celerity)) / below, celerity.y,
          celerity.z};
}

}  // namespace domefall
