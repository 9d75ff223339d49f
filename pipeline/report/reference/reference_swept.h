// These functions find the azimuth that a ray sweeps near a charge and in a wormhole, by Gauss's rule
// in 50-digit arithmetic, as the truth for pipeline/light, with which they share no code.
//
// Near a charge, M = 1, the observer is the tetrad T and delta counts from -R.  With f = 1 - 2/r + q^2/r^2
//
//     E = sin^2(delta/2) + f cos^2(delta/2)   L = r sin(delta)   k^r = f cos^2(delta/2) - sin^2(delta/2)
//     phi = int dw/sqrt(P)   P = E^2/L^2 - w^2 + 2 w^3 - q^2 w^4   w = 1/r
//
// Followed back in time a ray with k^r > 0 goes inwards up to the next root of P, and comes back.  In a
// wormhole, whose throat has the radius 1, phi = int b dl/(r sqrt(r^2 - b^2)) with b = r sin(delta).
#pragma once

#include <optional>

#include "pipeline/report/reference/reference_orbit.h"

namespace domefall {

// The sky of the observer's own exterior or side, that of the other one, one of an earlier universe, or
// none.
enum class ReferenceSky { kOwn, kOther, kEarlier, kNone };

struct SweptAzimuth {
  ReferenceSky sky;
  Real50 azimuth = 0;  // radians, without meaning where there is no sky
};

// Returns tan(delta/2) of the rays with |L/E| = kappa, whose light circles: of E > 0 outside r_c the
// silhouette's first, and between the horizons that of E < 0 second, negative.  q^2 <= 9/8, and r where
// there are such rays.
struct ChargedEdges {
  Real50 first, second;
};
ChargedEdges charged_edges(const Real50& q, const Real50& r);

// 0 < delta < pi, and no ray exactly on an edge.  A ray takes 5 ms.  Measured: within 1e-18 of every row
// of tests/reference/charged_rays.csv.
SweptAzimuth reference_charged_ray(const Real50& q, const Real50& r, const Real50& delta);

struct WormholeShape {
  Real50 half_length = 0;        // of the cylinder, a
  std::optional<Real50> mass{};  // m of the profile dngr; that of ellis has none
};

// Returns the angle between the edge of the throat and its middle, for an observer at l >= 0.
Real50 throat_angle(const WormholeShape& shape, const Real50& l);
// Measured: within 1e-17, relative, of every row of tests/reference/wormhole_rays.csv.
SweptAzimuth reference_wormhole_ray(const WormholeShape& shape, const Real50& l,
                                    const Real50& delta);

}  // namespace domefall
