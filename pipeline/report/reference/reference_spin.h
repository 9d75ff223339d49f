// reference_spin_ray() finds where light near a spinning, perhaps charged hole comes from, with 50
// digits, as the truth for pipeline/light, with which it shares no code.  Over Mino's time, with w = 1/r
// and h = a^2 + q^2, the ray of an observer who moves as the tetrad T obeys
//
//     w'^2 = p^2 - K w^2 d    p = E + a (aE - L) w^2    d = 1 - 2w + h w^2
//     N'' = -(C + 2 a^2 E^2 N_z^2) N + a^2 E^2 N_z z    C = K + 2aEL - a^2 E^2
//     psi' = a A - a E        A = K w^2/(p - w^2 r') = (p + w^2 r')/d
//
// where w'' is a polynomial in w, so that w passes a turn and 0 as any other place.  All of it is
// followed back in time by Taylor series; the place on the sky is N, turned by psi about the axis.
#pragma once

#include <array>

#include "pipeline/report/reference/reference_swept.h"

namespace domefall {

struct SpinView {
  Real50 spin, charge, r, theta;  // r above the inner horizon
  Real50 delta, eta;              // the direction, as in pipeline/light/kerr_start.h
};

struct SpinTruth {
  ReferenceSky sky;  // own, other, or none
  std::array<Real50, 3> place{};
};

// Measured: within 2e-20 of every row of tests/reference/kerr_rays.csv, which has 20 digits.  A ray
// takes 5 to 50 ms.
SpinTruth reference_spin_ray(const SpinView& view);

// Returns the delta of the edge, at the same eta, next to that of `guess`, where light circles next to
// r = x.  The quartic and its derivative by r vanish there.
Real50 spin_edge(const SpinView& guess, const Real50& x);

}  // namespace domefall
