// The methods behind integrate_ray.  Each takes a photon whose largest component is 1 and whose
// angular momentum is 0 or large enough to be squared.  The ray is followed to its end, or until it
// has swept `until` radians.
#pragma once

#include <limits>

#include "pipeline/light/integrated_ray.h"

namespace domefall {

// These follow the Schwarzschild and Kruskal second-order sets, by the paper's Runge-Kutta of
// fourth order, and by Dormand-Prince 5(4) and Fehlberg 7(8) of Boost.Odeint.
IntegratedRay paper_ray(const PhotonAtObserver& photon, double tolerance, double until);
IntegratedRay full_ray_dopri5(const PhotonAtObserver& photon, double tolerance, double until);
IntegratedRay full_ray_rkf78(const PhotonAtObserver& photon, double tolerance, double until);

// These follow the orbit's own equation, in which the azimuth is the variable.
IntegratedRay binet_ray_dopri5(const PhotonAtObserver& photon, double tolerance, double until);
IntegratedRay binet_ray_rkf78(const PhotonAtObserver& photon, double tolerance, double until);

inline IntegratedRay undecided_ray() {
  return {std::nullopt, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, {}};
}

// Returns the sky that an outgoing ray (backward in time) ends in.
inline SkyRegion sky_of(double energy) { return energy > 0 ? SkyRegion::kI : SkyRegion::kIII; }

}  // namespace domefall
