// This file has the Carter-Penrose diagram of the maximally extended Schwarzschild geometry
// (M = 1).  Kruskal's coordinates are each compactified by their arctangent:
//
//   U = eps exp((t + r*)/4)    V = eta exp(-(t - r*)/4)    U V = (1 - r/2) exp(r/2)
//   x = (arctan U - arctan V)/pi    up = (arctan U + arctan V)/pi
//
// where r* = r + 2 ln|r/2 - 1|, and the signs eps and eta are those of [Riazuelo] eq. defU, defV
// and table table_eps_eta, as in pipeline/spacetime/kruskal.h.  U and V grow towards the future, so
// light runs at 45 degrees and the future is up.  The singularities, U V = 1, are the straight
// lines up = 1/2 and up = -1/2 with |x| < 1/2.  The horizons are the diagonals x = up and x = -up.
// Region I is the diamond about (1/2, 0), with i0 at (1, 0) and i+ at (1/2, 1/2), and region III is
// its reflection.
//
// U and V are held as logarithms, so that t may be 1e12 and r 1e9.  Such a point lies in a corner.
// The error is 1e-15 of the diagram and a rounding of (t + r*)/4 in the logarithm.
#pragma once

#include "pipeline/spacetime/regions.h"

namespace domefall {

struct PenrosePoint {
  double x = 0;   // -1 to 1; region I is to the right
  double up = 0;  // -1/2 to 1/2; the future is up
};

// Returns the point at (t, r) of a region.  t belongs to the Killing vector that points to the
// future in region I, and therefore to the past in region III.  r = 2 gives the sphere U = V = 0,
// where all t meet.
PenrosePoint penrose_point(Region region, double t, double r);

// Returns the point of an observer whose null_time is v = t + r* in the rain frame or u = t - r* in
// the outgoing frame.  In the mirrored frames -t takes the place of t.  has_tetrad(region, tetrad)
// must hold, and r > 0 must be finite.  The result is regular on the horizon that the tetrad
// crosses, with r = 2 included.
PenrosePoint penrose_point(Region region, Tetrad tetrad, double r, double null_time);

}  // namespace domefall
