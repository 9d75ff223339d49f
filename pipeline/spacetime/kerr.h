// The spacetime of a spinning hole, Kerr's, or Kerr's and Newman's where it is charged, in units of its
// mass, M = c = G = 1:
//
//     Sigma = r^2 + a^2 cos^2 theta        Delta = r^2 - 2r + a^2 + q^2 = (r - r_+)(r - r_-)
//
// The spin a turns the hole towards growing phi.  a^2 + q^2 <= 1, so that there are two horizons r_+-
// = 1 +- d, d = sqrt(1 - a^2 - q^2).  Constants are kept to more digits than a double has: the marks of
// a hole that spins nearly as fast as it can lie closer together than doubles tell.
#pragma once

#include <cmath>
#include <optional>

namespace domefall {

struct KerrHole {
  long double spin = 0, charge = 0;
  // What the spin's decimals have beyond its rounding: 1e-14 of d where 1 - a = 1e-6.
  long double spin_rest = 0;

  bool operator==(const KerrHole&) const = default;

  // Returns d, half of r_+ - r_-.  That of an extremal hole, 0, is taken as 1e-9, as a spin gives that
  // differs from it in the last digit.
  long double horizon_distance() const {
    const long double square = ((1 - spin) - spin_rest) * (1 + spin) - charge * charge;
    return square > 1e-18L ? std::sqrt(square) : 1e-9L;
  }
  long double horizon() const { return 1 + horizon_distance(); }
  long double inner_horizon() const { return squares() / horizon(); }
  long double squares() const { return spin * spin + charge * charge; }
  long double delta(long double r) const {
    const long double d = horizon_distance();
    return ((r - 1) - d) * ((r - 1) + d);
  }
  // Returns r#, by which the angle of light that rises, phi - r#, and of light that falls, phi + r#,
  // differ from phi.  It is 0 at infinity, and infinite on the horizons.
  long double twist(long double r) const;
  // Returns r*, with which v = t + r* and u = t - r* are the times of light that falls and that rises.
  long double tortoise(long double r) const;
};

// A KerrCircle is a free circular orbit in the equatorial plane.  Bodies on it that go around with the
// hole's spin are prograde.
struct KerrCircle {
  double time, angle;  // u^t, and u^phi of either sign
};
// Returns nothing at and within the circle of light, where no such orbit is.
std::optional<KerrCircle> kerr_circle(const KerrHole& hole, double r, bool prograde);

// Returns r of the circle on which light goes around in the equatorial plane.
double kerr_light_circle(const KerrHole& hole, bool prograde);

// Returns r of the last stable circle.
double last_stable_circle(const KerrHole& hole, bool prograde);

// Returns the flux of a thin disc without a torque at the last stable circle, after Page & Thorne (ApJ
// 191, 499), in units of the accretion rate/(4 pi) per M^2, and 0 within that circle.  The hole must
// have no charge.
double page_thorne_flux(const KerrHole& hole, double r, bool prograde);

}  // namespace domefall
