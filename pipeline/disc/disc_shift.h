// This file gives the shift of a disc's light on its way to an observer.  Gas on a circular orbit
// has u^t = 1/sqrt(1 - 3/r) and turns with Omega = r^(-3/2) about the disc's axis n.  It sends
// light of the ray with E, L at (M = 1)
//
//     1 + z = u^t (E - Omega L_n) / (k.u),      L_n = -L (r^ x e^).n
//
// times the frequency that the observer measures, k.u.  Here r^ is the observer's place and e^ the
// tangent in which the ray sweeps its angle, followed back in time.  In the tetrad of radial free
// fall k.u = 1.  For whoever moves against it the result is multiplied by the frequency there over
// the one observed, AberratedLight::frequency_ratio of to_tetrad().
//
// Inside the last stable orbit gas plunges with the energy E' = sqrt(8/9) and the angular momentum
// L' = 2 sqrt 3 of that orbit (Cunningham, ApJ 202, 788 (1975)).  Then u^r = -(6/r - 1)^(3/2)/3,
// and
//
//     1 + z = [(E' E - u^r k^r)/(1 - 2/r) - L' L_n/r^2] / (k.u).
#pragma once

#include "pipeline/optics/null_ray.h"
#include "trajectories/directions.h"

namespace domefall {

// A DiscRay holds what decides, of a view ray, the shift of the discs that it meets.
struct DiscRay {
  double energy;            // E, > 0 wherever it meets a disc
  double angular_momentum;  // L >= 0
  double about_axis;        // L_n
};

// The place, the tangent and the normal are r^, e^ and n, unit vectors of one frame.  It may be the
// tetrad's (R, Theta, Phi) or the celestial sphere's.
DiscRay disc_ray(const RayInvariants& ray, const V3d& place, const V3d& tangent, const V3d& normal);

// Returns the frequency that gas at r sends over the one that radial free fall at the observer's
// place sees, for r > 2 (units of M) in region I.  The gas plunges where r < 6.  `outward` says
// whether the light sets out to larger radii, which matters to plunging gas alone.  The result is
// infinite where light sets out outward from the horizon.
double disc_shift(const DiscRay& ray, double r, bool outward);

}  // namespace domefall
