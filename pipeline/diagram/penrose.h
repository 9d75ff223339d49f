// Carter-Penrose diagram of the maximally extended Schwarzschild geometry (M = 1): Kruskal's
// coordinates, each pressed into a finite range by its arctangent.
//
//   U = eps exp((t + r*)/4)    V = eta exp(-(t - r*)/4)    U V = (1 - r/2) exp(r/2)
//   x = (arctan U - arctan V)/pi    up = (arctan U + arctan V)/pi
//
// with r* = r + 2 ln|r/2 - 1| and the signs of [Riazuelo] eq. defU, defV, table table_eps_eta, as in
// pipeline/optics/kruskal.h: both grow towards the future, so light runs at 45 degrees and the
// future is up.  The singularities, U V = 1, are the straight lines up = 1/2 and -1/2 with
// |x| < 1/2; the horizons are the diagonals x = up and x = -up; region I is the diamond about
// (1/2, 0) with i0 at (1, 0) and i+ at (1/2, 1/2), region III its reflection.
//
// U and V are held as logarithms: t may be 1e12 and r 1e9, such a point lies in the corner.
// Accuracy: 1e-15 of the diagram and a rounding of (t + r*)/4 in the logarithm.
#pragma once

#include "trajectories/observer_state.h"

namespace domefall {

struct PenrosePoint {
  double x = 0;   // -1 to 1; region I is to the right
  double up = 0;  // -1/2 to 1/2; the future is up
};

// r* = r + 2 ln|r/2 - 1|, 0 at the singularity; minus infinity at r = 2.  r >= 0, finite.
double tortoise(double r);

// The point at (t, r) of a region; t is that of the Killing vector which points to the future in
// region I, so to the past in region III.  At r = 2 the sphere U = V = 0, where all t meet.
PenrosePoint penrose_point(Region region, double t, double r);

// Where an observer is whose null_time is v = t + r* (rain) or u = t - r* (outgoing frame); of the
// mirrored frames -t takes t's place.  has_tetrad(region, tetrad), r > 0 finite.  Regular on the
// horizon that the tetrad crosses, r = 2 included.
PenrosePoint penrose_point(Region region, Tetrad tetrad, double r, double null_time);

}  // namespace domefall
