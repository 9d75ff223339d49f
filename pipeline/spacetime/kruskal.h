// This file has Kruskal's coordinates of the maximally extended Schwarzschild geometry (M = 1),
// held so that no exponential overflows, and the way between them and (region, t, r).
//
//   U = eps exp((t + r*)/4)    V = eta exp(-(t - r*)/4)    r* = r + 2 ln|r/2 - 1|
//   U V = -(r/2 - 1) exp(r/2)                          [Riazuelo] eq. defU, defV, res_UV
//
// The signs are those of [Riazuelo] table table_eps_eta: I (+,-), II (+,+), III (-,+), IV (-,-).
// Both coordinates grow towards the future.  U = 0 is the horizon between I and IV and between II
// and III, V = 0 that between I and II and between III and IV.
//
// A shift of t, U -> U e^a and V -> V e^-a, is a symmetry, so a point is held as that shift and a
// pair (u, v) of about equal size.  Far from the hole a common growth is held apart as well:
//
//   U = u exp(growth + shift/4)    V = v exp(growth - shift/4)
//
// The domain is r from 0 (excluded) to 1e300 and any finite t.  The tests measured the accuracy.
// radius_less_two is right to a relative 1e-15 beside the horizon, down to 1e-300.  r comes back to
// 4e-15, and t to 4e-15 of 1 + |t|, where r >= 1/2.  Near the singularity U V -> 1 and the product
// forgets r.  The relative error of r is about 1e-15 / r^2 there, so small radii are no place for
// these coordinates.
#pragma once

#include "pipeline/spacetime/regions.h"

namespace domefall {

struct KruskalPoint {
  double u = 0, v = 0;
  double shift = 0;   // units of M: the t of a point with |u| = |v|
  double growth = 0;  // 0 but where r > kLargestPlainRadius
};

// Beyond this radius kruskal_point holds exp(r/4) apart.
inline constexpr double kLargestPlainRadius = 100;

// These return the signs of U and V in the inside of a region.
double sign_of_u(Region region);
double sign_of_v(Region region);

// Returns the region of a point.  A point of a horizon belongs to the region of larger r (I or
// III), and the sphere U = V = 0 to region I.
Region kruskal_region(double u, double v);

// Returns the point at (t, r) of a region, with |u| = |v| and shift = t.  At r = 2, where t is
// infinite in these coordinates, it is the sphere U = V = 0 that all t meet in.
KruskalPoint kruskal_point(Region region, double t, double r);

// Returns r - 2 from the product U V <= 1, by Lambert's W on its main branch.  It keeps its
// relative accuracy at the horizon, and is NaN beyond the singularity (U V > 1).
double radius_less_two(double product_uv);

double kruskal_radius(const KruskalPoint& p);

// Returns t, which is infinite on a horizon and NaN on the sphere U = V = 0.
double kruskal_time(const KruskalPoint& p);

}  // namespace domefall
