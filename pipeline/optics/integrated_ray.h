// A light ray followed backward in time, step by step, from an observer to where it came from: sky I,
// sky III or the past singularity of the maximally extended Schwarzschild geometry (M = 1).
//
// It shares no formula with exact_azimuth, sky_table or null_ray: it is the check of them, and the
// error-against-cost side of the report.  Where a ray ends is found by getting there, never by
// comparing an impact parameter with 3 sqrt(3).
#pragma once

#include "trajectories/observer_state.h"

namespace domefall {

// A photon as it reaches the observer, by components that are invariant or regular at the horizon.
// Only ratios of the last three matter.
//
// Regions I and III: r >= 2, and the energy's sign is the region's (|energy| is used).
// Region II: r <= 2, radial < 0.  Region IV: r <= 2, radial > 0.  All three of energy, momentum and
// radial are to obey radial^2 = energy^2 - (1 - 2/r)(angular_momentum/r)^2.
struct PhotonAtObserver {
  Region region = Region::kI;
  double r = 0;                 // units of M, 1e-6 to 1e8
  double energy = 0;            // g_tt k^t: > 0 for light on its way from sky I, < 0 from sky III
  double angular_momentum = 0;  // r |tangential part of k| >= 0
  double radial = 0;            // k^r
};

enum class Integrator { kPaperRk4, kFullDopri5, kFullRkf78, kBinetDopri5, kBinetRkf78 };

enum class RayEnd { kSkyOne, kSkyThree, kPastSingularity, kUndecided };

struct IntegratedRay {
  RayEnd end = RayEnd::kUndecided;
  double phi = 0;        // swept azimuth, radians; NaN if undecided
  long steps = 0;        // attempted, rejected ones included
  long evaluations = 0;  // of the right-hand side
};

// No ray takes more attempted steps; one that would is undecided.
inline constexpr long kRayStepBudget = 100000;

// tolerance: the relative error allowed to each step, 1e-3 to 1e-13.
IntegratedRay integrate_ray(const PhotonAtObserver& photon, Integrator integrator,
                            double tolerance);

}  // namespace domefall
