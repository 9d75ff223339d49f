// These are the edges of what an observer in the rain frame sees, in closed form, with M = 1.  With
// s = sqrt(2/r), both are roots of (1+s) T^2 - (2r/sqrt 27) T + (1-s) = 0 in T = tan(delta/2),
// where delta is the angle from -R.  They are the rays with |L/E| = 3 sqrt 3.
#pragma once

#include "pipeline/spacetime/radius.h"

namespace domefall {

// Returns tan(delta/2) of the silhouette's edge, beyond which sky I lies.  [Riazuelo] eq.
// tan_delta_final.  r > 0 is needed, and flat space (r infinite) has 0.  For r > 3 the numerator is
// a small difference of large terms, so its conjugate is used.  Measured against 40 digits, the
// relative error is < 4 epsilon for 1e-6 < r < 1e8.
double tan_half_silhouette(const Radius& at);

// Returns tan(delta/2) of the edge of region III, which lies within it.  [Riazuelo] sec.
// sec_Kruskal.  0 < r <= 2 is needed, and the result is zero at r = 2, where the region appears as
// a point.
double tan_half_region_three(const Radius& at);

// Returns the other root of the quadratic.  It is negative inside the horizon, where it is
// -tan_half_region_three.
double tan_half_other_root(const Radius& at);

// These return the same to more digits than a double has.  Deep inside, where the edges close in on
// each other, an angle is measured from them more finely than a double can.  0 < r < infinity.
long double tan_half_silhouette_long(const Radius& at);
long double tan_half_other_root_long(const Radius& at);

double silhouette_edge(const Radius& at);    // radians
double region_three_edge(const Radius& at);  // radians

}  // namespace domefall
