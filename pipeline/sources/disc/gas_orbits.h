// The orbits of a disc's gas in the plane of a hole's equator (M = 1).  The hole has the spin a, which
// is negative where the gas goes against it, and the charge q.  With Delta = r^2 - 2r + a^2 + q^2 and
// w = sqrt(r - q^2), gas on a circle turns with
//
//     Omega = w/(r^2 + a w),    (1/u^t)^2 = r^2 (r^2 - 3r + 2 q^2 + 2 a w)/(r^2 + a w)^2.
//
// The circles are stable down to r_s.  Inside, gas plunges with the energy E' and the angular momentum
// L' of that circle (Cunningham, ApJ 202, 788 (1975)).  There u^r has a triple root at r_s:
//
//     -u^r = sqrt[(1 - E'^2) (r_s - r)^3 (r - c)]/r^2,    c = q^2 (L' - a E')^2/[(1 - E'^2) r_s^3],
//
// which is (6/r - 1)^(3/2)/3 without spin and charge.
#pragma once

#include <cmath>

#include "pipeline/spacetime/charged.h"
#include "pipeline/spacetime/kerr.h"

namespace domefall {

// A GasRay holds what decides the shift of light by the motion of gas about an axis n.
struct GasRay {
  double energy;      // E, > 0 wherever it meets gas
  double momentum;    // sqrt K of Carter's constant, the angular momentum L >= 0 without spin
  double about_axis;  // L_n
};

class GasOrbits {
 public:
  // q <= 1.
  explicit GasOrbits(const ChargedHole& hole = {});
  GasOrbits(const KerrHole& hole, bool retrograde);

  bool operator==(const GasOrbits& other) const {
    return square_ == other.square_ && spin_ == other.spin_;
  }

  double spin() const { return spin_; }
  double charge_squared() const { return square_; }
  double horizon() const { return horizon_; }
  double last_stable() const { return last_stable_; }   // r_s
  double plunge_energy() const { return energy_; }      // E'
  double plunge_momentum() const { return momentum_; }  // L'

  double delta(double r) const { return (r - 2) * r + spin_ * spin_ + square_; }
  // Pixels ask these, of which what a charge and a spin add is left out without them.  They return
  // (1/u^t)^2 and Omega of a circle, per M of t, and -dln(Omega)/dln(r).
  double slowing_squared(double r) const {
    const double charged = square_ > 0 ? 1 - 3 / r + 2 * square_ / (r * r) : 1 - 3 / r;
    if (!(spin_ != 0)) return charged;
    const double dragged = spin_ * circling_of_charge(r);
    return (charged + 2 * dragged) / ((1 + dragged) * (1 + dragged));
  }
  double circling(double r) const {
    const double charged = circling_of_charge(r);
    return spin_ != 0 ? charged / (1 + spin_ * charged) : charged;
  }
  double shear(double r) const {
    const double charged = square_ > 0 ? 2 - 0.5 * r / (r - square_) : 1.5;
    return spin_ != 0 ? charged / (1 + spin_ * circling_of_charge(r)) : charged;
  }
  // Returns Omega of the plunge, r from the horizon on.
  double plunging(double r) const {
    const double square = r * r + spin_ * spin_, p = square * energy_ - spin_ * momentum_,
                 y = momentum_ - spin_ * energy_, above = delta(r);
    return (spin_ * p + above * y) / (square * p + spin_ * above * y);
  }
  double angular_velocity(double r) const { return r < last_stable_ ? plunging(r) : circling(r); }

  // Returns -u^r, r <= r_s, and that over the factor of (r_s/r - 1)^(3/2) with which it begins.
  double plunge_speed(double r) const { return fall(r) / slowness_; }
  double fall(double r) const {
    const double beyond = last_stable_ / r - 1;
    return beyond * std::sqrt(beyond) * std::sqrt((1 - root_ / r) / (1 - root_ / last_stable_));
  }

 private:
  double circling_of_charge(double r) const {
    const double plain = 1 / (r * __builtin_sqrt(r));
    return square_ > 0 ? plain * __builtin_sqrt(1 - square_ / r) : plain;
  }
  void set_plunge();

  double spin_ = 0, square_, horizon_, last_stable_;
  double energy_ = 0, momentum_ = 0, root_ = 0, slowness_ = 0;  // root_ is c
};

}  // namespace domefall
