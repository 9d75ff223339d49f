// This file says which curve an orbit with given constants follows, and where on it a given state
// is.
#pragma once

#include "trajectories/orbit_curve.h"

namespace domefall {

// A Barrier is the unstable circular orbit of an angular momentum, at the top of the potential
// V = (1 - 2w)(1 + L^2 w^2) with w = 1/r.  About it
// E^2 - V = P(w_b) + 2 L^2 (w - w_b)^2 (w - w_b + spread).
struct Barrier {
  double w;       // of its radius; 1/6 to 1/3
  double spread;  // 3w - 1/2 = sqrt(1 - 12/L^2)/2: from w to the third root of the top's cubic
};
Barrier barrier_of(double angular_momentum);  // L^2 >= 12

// BarrierRoots are the roots w2 < w_b < w3 on both sides of the barrier, as w_b - w2 and w3 - w_b,
// where P(w_b) = -depth and depth > 0.  They have relative accuracy, however small they are.
struct BarrierRoots {
  double below, above;
};
BarrierRoots roots_beside(const Barrier& barrier, double angular_momentum, double depth);

// Returns the orbit from infinity that turns at a barrier it stays `depth` below.
OrbitCurve scattered_orbit(const OrbitConstants& constants, double depth);

struct OrbitStart {
  OrbitCurve curve;
  double parameter;
};

// Returns the geodesic through r with the radial velocity dr/dtau = speed, outside the hole or
// inside it.
OrbitStart orbit_through(const OrbitConstants& constants, double r, double speed);

// An orbit that would whirl longer than one of this excess is taken to have this one, because
// rounding has long decided what it does.
inline constexpr double kLeastExcess = 1e-20;

}  // namespace domefall
