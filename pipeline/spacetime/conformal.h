// These are the Carter-Penrose diagrams of a charged hole and of a wormhole, beside that of
// Schwarzschild's (penrose.h).  The times v = t + r* and u = t - r* of light that falls and that rises
// are each compactified by
//
//     h(x) = arctan(sinh(kappa x)/(4 kappa))/pi        kappa = (r_+ - r_-)/(2 r_+^2)
//
// which is regular on the outer horizon, whose surface gravity kappa is, and for kappa = 1/4 is
// Schwarzschild's.  Without two horizons it is arctan(x/4)/pi.  Light runs at 45 degrees, the future
// is up, and curves of constant r = 0 are vertical.  In a charged hole of two horizons
//
//     I    h(v)        h(u)          V   h(v)        2 + h(u)
//     II   h(v)        1 - h(u)      IV  -1 - h(v)   h(u)
//
// are the coordinates (p, q) of x = (p - q + 1)/2 and up = (p + q)/2; III and VI are the mirror images
// of I and V.  Each further universe lies 2 higher.  With one horizon V has (h(v), 1 + h(u)), and each
// further universe lies 1 higher.
#pragma once

#include "pipeline/spacetime/charged.h"
#include "pipeline/spacetime/penrose.h"
#include "pipeline/spacetime/wormhole.h"

namespace domefall {

// Returns how much higher the next universe lies.
double universe_height(const ChargedHole& hole);

// Returns the point at (t, r) of a region I, II, IV or V.  t grows with v and u throughout.
PenrosePoint penrose_point(const ChargedHole& hole, Region region, int universe, double t,
                           double r);

// Returns the point of an observer, as penrose_point() of penrose.h.  It is regular on the horizons
// that the tetrad crosses, these included.
PenrosePoint penrose_point(const ChargedHole& hole, Region region, int universe, Tetrad tetrad,
                           double r, double null_time);

// Returns the point at (t, l) of a wormhole, all of which is one diamond, with its throat at x = 0.
PenrosePoint penrose_point(const Wormhole& wormhole, double t, double l);

}  // namespace domefall
