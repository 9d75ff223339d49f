// A parabolic orbit comes from rest at infinity, goes around the hole and back ([Riazuelo] eq.
// r_par, vit_par, fig. figpar).  It has E = 1 and L = r_p sqrt(2/(r_p - 2)) > 4.  tau = 0 at the
// periastron r_p > 4.  Close to L = 4 the orbit whirls at r = 4, through some sqrt(2) ln(1/excess)
// radians more.  The functions throw std::domain_error that names the bound.
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
