#include "trajectories/observer_state.h"

#include <cmath>

#include "trajectories/kerr_motion.h"

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

// About a hole that spins it is l + (Delta/2 Sigma) n - a sin(theta) Phi/sqrt Sigma.
std::pair<double, V3d> static_time(const ObserverState& o) {
  const auto* hole = std::get_if<SpinningHole>(&o.spacetime.kind());
  if (!hole) {
    const auto [t, s] = o.spacetime.static_time(o.r);
    return {t, V3d(is_outgoing(o.tetrad) ? -s : s, 0, 0)};
  }
  const auto a = static_cast<double>(hole->kerr.spin);
  const double theta = polar_angle(o, *hole), cosine = std::cos(theta);
  const double sigma = o.r * o.r + a * a * cosine * cosine,
               f = static_cast<double>(hole->kerr.delta(o.r)) / sigma;
  return {(1 + f) / 2, V3d((1 - f) / 2, 0, -a * std::sin(theta) / std::sqrt(sigma))};
}

double polar_angle(const ObserverState& o, const SpinningHole& hole) {
  const V3d r = column(o.sky_from_tetrad, 0);
  return std::atan2(r.cross(axis_of(hole)).length(), r.dot(axis_of(hole)));
}

Celerity<ReferenceTetrad> resting_celerity(const ObserverState& o) {
  const auto* hole = std::get_if<SpinningHole>(&o.spacetime.kind());
  if (!hole || !has_rest(o)) return resting_celerity(o.spacetime, o.r, o.tetrad);
  const double theta = polar_angle(o, *hole);
  return kerr_dragged(hole->kerr, o.r, theta).celerity;
}

Celerity<RestFrame> static_celerity(const ObserverState& o) {
  if (o.spacetime.is<SpinningHole>())
    return celerity_against(Celerity<RestFrame>(-resting_celerity(o)), o.celerity);
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
