// These orbits come from the past singularity, through region IV ([Riazuelo] sec. sec_Kruskal,
// eq. TR_IV).
//
//   E = 0             IV -> II through r = 2 itself, tau = 0 there; of L = 0 the cycloid
//                     r = 1 + cos eta, tau = eta + sin eta, at rest in t
//   E < 1             IV -> I -> II, tau = 0 at the apoastron in I
//   E >= 1, small L   IV -> I and to infinity, tau = 0 at the past horizon, r = 2
//   E >= 1, L beyond capture_angular_momentum(v) of hyperbolic_orbit.h   IV -> I -> II as above
//
// mirrored() exchanges I and III.  So it makes IV -> III -> II and IV -> III of these, and III ->
// II of orbits that fall from I.  Close to E = 0 the states about the apoastron have celerities
// about 1/E.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

// Takes E >= 0 per unit of mass and L >= 0 (M), but refuses 0 < E < 1e-6.  Throws std::domain_error
// that names the bound.
Geodesic kruskal_crossing(double energy, double angular_momentum = 0);

}  // namespace domefall
