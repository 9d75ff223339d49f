// integrate_ray() follows a light ray backward in time, step by step, from an observer to where it
// came from: sky I, sky III or the past singularity of the maximally extended Schwarzschild
// geometry (M = 1).
//
// It shares no formula with exact_azimuth, sky_table or null_ray.  It checks them, and it is what
// the report compares them with by error and cost.  Where a ray ends is found by getting there,
// never by comparing an impact parameter with 3 sqrt(3).
//
// The paper's method is Runge-Kutta of 4th order with step doubling, on the second-order
// Schwarzschild and Kruskal sets with the paper's step rules.  The next two use the same sets, and
// the last two integrate w'' = 3 w^2 - w with w = 1/r.
//
//   kPaperRk4                    Runge-Kutta of 4th order
//   kFullDopri5, kFullRkf78      Dormand-Prince 5(4), Fehlberg 7(8)
//   kBinetDopri5, kBinetRkf78    Dormand-Prince 5(4), Fehlberg 7(8)
//
// The accuracy was measured on the 464 rows of tests/reference/rays.csv that are at least 1e-3 rad
// off an edge, with observers of all regions and r from 1e-6 to 1e8.  Every origin is right from
// tolerance 1e-4 down.  Beside what rounding did to the photon,
//   |error of phi| < 4 tolerance (phi + |dphi/ddelta|).
// From tolerance 1e-6 down this also holds 1e-6 beside an edge, and the origin is sure where the
// bound is small.  The next table has errors (median; largest, where phi changes a thousandfold
// with delta) and the time per ray (one core, g++ 12 -O3), for tolerances 1e-6, 1e-9 and 1e-12:
//   kPaperRk4      2e-8; 9e-6   53 us    2e-11; 1e-8  134 us    3e-14; 8e-11  520 us
//   kFullDopri5    2e-7; 2e-4   27 us    1e-10; 3e-7   69 us    2e-13; 4e-10  230 us
//   kFullRkf78     2e-8; 1e-4   26 us    2e-10; 7e-7   38 us    5e-13; 1e-9    80 us
//   kBinetDopri5   3e-7; 3e-4  1.2 us    9e-11; 4e-7  2.7 us    5e-14; 6e-10  7.4 us
//   kBinetRkf78    4e-8; 1e-4  1.8 us    1e-10; 4e-7  2.4 us    2e-13; 5e-10  3.4 us
// The paper's method gains by its extrapolated step, and pays for it in steps.  Of 79000 random
// rays (tolerances 1e-3 to 1e-13) none was undecided or had an origin that the methods disagreed
// about.
#pragma once

#include <optional>

#include "pipeline/spacetime/regions.h"

namespace domefall {

// A PhotonAtObserver is a photon as it reaches the observer, by components that are invariant or
// regular at the horizon.  Only ratios of the last three matter.
//
// In regions I and III r >= 2, and the energy's sign is the region's, since |energy| is used.  In
// region II r <= 2 and radial < 0.  In region IV r <= 2 and radial > 0.  The three components are
// to obey radial^2 = energy^2 - (1 - 2/r)(angular_momentum/r)^2 up to rounding.  Beside the horizon
// the larger of energy + radial and energy - radial is believed.  On the horizon either region that
// it bounds may be named, and light along it (energy = radial = 0) is undecided.
struct PhotonAtObserver {
  Region region = Region::kI;
  double r = 0;                 // units of M, 1e-6 to 1e8
  double energy = 0;            // g_tt k^t: > 0 for light on its way from sky I, < 0 from sky III
  double angular_momentum = 0;  // r |tangential part of k| >= 0
  double radial = 0;            // k^r
};

// NullTimes are the null coordinates of a place less those of the observer, v = t + r* and u = t -
// r* with r* = r + 2 ln|r/2 - 1|, in units of M.  One that is infinite at the place or at the
// observer, as that of the other horizon is, becomes NaN or infinite.
struct NullTimes {
  double v = 0, u = 0;
};

enum class Integrator { kPaperRk4, kFullDopri5, kFullRkf78, kBinetDopri5, kBinetRkf78 };

struct IntegratedRay {
  // This says where the light started.  It is empty for a ray that has not arrived, or that whirls
  // at the light circle for ever.
  std::optional<SkyRegion> origin;
  double phi = 0;        // swept azimuth, radians; NaN if undecided
  long steps = 0;        // attempted, rejected ones included
  long evaluations = 0;  // of the right-hand side; none for a radial ray of Binet's equation
  double r = 0;          // where it was stopped on its way (units of M); 0 if it was not
  NullTimes passed;      // of the stopped ray: when its light was there
};

// No ray takes more attempted steps than this.  One that would is undecided.
inline constexpr long kRayStepBudget = 100000;

// Integrates to the end of the ray.  The tolerance is the relative error allowed to each step, 1e-3
// to 1e-13.  This throws nothing.
IntegratedRay integrate_ray(const PhotonAtObserver& photon, Integrator integrator,
                            double tolerance);

// Says where the ray is after having swept psi > 0 radians, as IntegratedRay::r and passed.  It
// does not if the ray has ended before, which `origin` tells, or whirls for ever.  r lies between
// 1e-10 and 1e15.  The step control of Binet's equation includes the time, and the second-order
// sets carry t along.
IntegratedRay integrate_ray_to(double psi, const PhotonAtObserver& photon, Integrator integrator,
                               double tolerance);

}  // namespace domefall
