// The orbits of a disc's gas about a hole of charge q, which is 0 of Schwarzschild's (M = 1).  With
// w = 1/r and f = 1 - 2w + q^2 w^2, gas on a circle turns with
//
//     Omega = w^(3/2) sqrt(1 - q^2 w),    u^t = 1/sqrt(1 - 3w + 2 q^2 w^2).
//
// The circles are stable down to r_s, where r^3 - 6 r^2 + 9 q^2 r - 4 q^4 = 0.  Inside, gas plunges
// with the energy E' and the angular momentum L' of that circle (Cunningham, ApJ 202, 788 (1975)).
// There u^r, as a quartic in w with a triple root at w_s, is
//
//     -u^r = L' (w - w_s)^(3/2) sqrt(2 - q^2 (3 w_s + w)),
//
// which is (6/r - 1)^(3/2)/3 without a charge, and Omega = f w^2 L'/E'.
#pragma once

#include <cmath>

#include "pipeline/spacetime/charged.h"

namespace domefall {

class GasOrbits {
 public:
  // q <= 1.
  explicit GasOrbits(const ChargedHole& hole = {});

  bool operator==(const GasOrbits& other) const { return square_ == other.square_; }

  double charge_squared() const { return square_; }
  double horizon() const { return horizon_; }
  double last_stable() const { return last_stable_; }   // r_s
  double plunge_energy() const { return energy_; }      // E'
  double plunge_momentum() const { return momentum_; }  // L'

  double lapse_squared(double r) const { return 1 - 2 / r + square_ / (r * r); }
  // Pixels ask these, of which what a charge adds is left out without one.  They return (1/u^t)^2 and
  // Omega of a circle, per M of t, and -dln(Omega)/dln(r).
  double slowing_squared(double r) const {
    return square_ > 0 ? 1 - 3 / r + 2 * square_ / (r * r) : 1 - 3 / r;
  }
  double circling(double r) const {
    const double plain = 1 / (r * __builtin_sqrt(r));
    return square_ > 0 ? plain * __builtin_sqrt(1 - square_ / r) : plain;
  }
  double shear(double r) const { return square_ > 0 ? 2 - 0.5 * r / (r - square_) : 1.5; }
  // Returns Omega of the plunge, r from the horizon on.
  double plunging(double r) const { return lapse_squared(r) * turning_ / (r * r); }
  double angular_velocity(double r) const { return r < last_stable_ ? plunging(r) : circling(r); }

  // Returns -u^r, r <= r_s, and that over the factor of (r_s/r - 1)^(3/2) with which it begins.
  double plunge_speed(double r) const { return fall(r) / slowness_; }
  double fall(double r) const {
    const double beyond = last_stable_ / r - 1;
    return beyond * std::sqrt(beyond) *
           std::sqrt((2 - square_ * (3 / last_stable_ + 1 / r)) / (2 - 4 * square_ / last_stable_));
  }

 private:
  double square_, horizon_, last_stable_, energy_, momentum_, turning_, slowness_;
};

}  // namespace domefall
