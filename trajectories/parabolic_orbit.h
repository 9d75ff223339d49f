// A parabolic orbit comes from rest at infinity, goes around the hole and back.  It has E = 1 and
// L > 4.  [Riazuelo] eq. r_par, vit_par, fig. figpar.  tau = 0 at the periastron, which is 4 < r_p,
// and L = r_p sqrt(2/(r_p - 2)).  Close to L = 4 the orbit whirls at r = 4, some
// ln(1/excess)/sqrt(2) radians longer.  The functions throw std::domain_error that names the bound.
#pragma once

#include "trajectories/geodesic.h"

namespace domefall {

inline constexpr double kParabolicInnermost = 4;        // M; the periastron must exceed it
inline constexpr double kParabolicAngularMomentum = 4;  // M; at or below it there is no way back

Geodesic parabolic_by_periastron(double periastron);
Geodesic parabolic_by_angular_momentum(double angular_momentum);
// Here L = 4 (1 + excess), with excess >= 1e-20.
Geodesic parabolic_by_excess(double excess);

}  // namespace domefall
