// Finds the azimuth that a ray sweeps between where it came from, the sky at infinity or the past
// singularity, and the observer.  It is Carlson's elliptic integral R_F, and the tables are made
// from it.
//
//     phi = int dw / sqrt(P),   P(w) = 1/b^2 - w^2 + 2 w^3,   w = 1/r,
//
// [Riazuelo] app. app_geod.  From the sky the path begins at w = 0, from the singularity at w =
// infinity, and it may turn on its way.  With w = 1/3 + x and eps = 1/b^2 - 1/27, P = 2 x^3 + x^2 +
// eps.  Here eps is formed from (E - L/sqrt 27)(E + L/sqrt 27)/L^2, where each factor is carried
// without cancellation, and so are all differences of roots.  The integrals over cubics are those
// of Carlson, Math. Comp. 51 (1988) 267 for three real roots and 56 (1991) 267 for one real root.
#pragma once

#include "pipeline/light/null_ray.h"

namespace domefall {

struct Cubic;

// Returns the azimuth in radians.  It is >= 0 and unbounded towards an edge, 0 for a radial ray,
// and infinite for one that circles for ever.  Flat space has phi = pi - delta and needs no
// integral.  Measured against 40 digits over 1e-6 <= r <= 1e8 and offsets from an edge down to
// 1e-15, the error is below 1e-13 max(1, phi).
double exact_azimuth(const NullRay& ray);

// EndAzimuths are the azimuths between the observer's w and each end of the orbit, w = 0 (a sky)
// and w = infinity (the singularity), without turning on the way.  One is infinite for an end that
// the orbit does not have on the observer's side.  They are in radians and as accurate as
// exact_azimuth.  L must be > 0.
struct EndAzimuths {
  double sky, singularity;
};
EndAzimuths end_azimuths(const Cubic& c);

// Returns the angle over which phi changes its shape.  It is the angle to the nearest place where
// phi diverges or, as for light from the singularity on the axis, has the branch point of a cube
// root.
double smooth_over(const NullRay& ray);

// Returns d phi/d alpha, signed, by a four-point difference over turned rays.  The measured
// relative error is below 1e-9.  The ray must not be exactly radial or critical.
double exact_slope(const NullRay& ray);

}  // namespace domefall
