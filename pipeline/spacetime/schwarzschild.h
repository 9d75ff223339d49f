// The Schwarzschild spacetime in units of its mass, M = c = G = 1:
//
//     ds^2 = f dt^2 - dr^2/f - r^2 dOmega^2        f = 1 - 2/r
//
// What is true of the space itself is said here once, for every observer, orbit and ray: the places
// that mark it, the speed of radial free fall from rest at infinity (s, of the rain and outgoing
// tetrads), f and r*.  Each takes the Radius with its distances, so that it is right from r -> 0
// across the horizon to flat space (r infinite) to some roundings, unless it says otherwise.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/spacetime/radius.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

// GM/c^3 of the sun (IAU 2015 nominal GM) is the length in seconds of one M of a hole of one solar
// mass.
inline constexpr double kSecondsPerSolarMass = 4.925490947e-6;

struct Schwarzschild {
  double mass_solar = 1;  // > 0; it gives one M its length and decides nothing else

  bool operator==(const Schwarzschild&) const = default;

  std::optional<double> solar_masses() const { return mass_solar; }
  double seconds_per_m() const { return mass_solar * kSecondsPerSolarMass; }
  static std::vector<double> parameters() { return {}; }

  static constexpr double horizon() { return 2; }
  static constexpr double inner_horizon() { return 0; }
  static constexpr double above_horizon(double r) { return r - 2; }
  static constexpr double light_circle() { return 3; }       // where light circles
  static constexpr double last_stable_orbit() { return 6; }  // of what has mass
  static double circling_time(double r) { return std::sqrt(r - 3); }
  // b = L/E of the light that circles, 3 sqrt 3.  An edge of a sky is a ray of this |b|.
  static constexpr double kCriticalImpact = 5.196152422706632;

  // Returns s = sqrt(2/r), the speed against observers at rest.  It exceeds 1 inside the horizon.
  template <class Real>
  static Real free_fall_speed(Real r) {
    return std::sqrt(2 / r);
  }

  static StaticTime static_time(double r) { return {1, free_fall_speed(r)}; }
  static double fall_celerity(double) { return 0; }  // the rain tetrad itself

  // Returns 1 - s, by (1 - s^2)/(1 + s), which does not cancel next to the horizon.
  static double below_light_speed(const Radius& at) {
    if (std::isinf(at.r)) return 1;
    return at.above_horizon / (at.r * (1 + free_fall_speed(at.r)));
  }

  // Returns f = 1 - 2/r, of either sign.  Its root is the rate of a clock at rest.
  static double lapse_squared(const Radius& at) {
    return std::isinf(at.r) ? 1 : at.above_horizon / at.r;
  }

  static double lapse_squared_above(double r, double above) { return above / r; }

  // Returns gamma v along R, against the rain tetrad, of what is at rest in r (outside) or in t
  // (inside, T_II and T_IV of [Riazuelo] eq. TR_IV), for r != 2.
  static double resting_celerity(double r) {
    return r > 2 ? std::sqrt(2 / (r - 2)) : std::sqrt(r / (2 - r));
  }

  // Returns the celerity along R that a motion has in the rain tetrad, or in the outgoing one, from
  // u^r = dr/dtau, its energy E and (1 - E^2) + l^2, where l = r dphi/dtau.  In rain it is
  // w = (u^r + sE)/(1 - 2/r) or ((1 - E^2) + l^2)/(sE - u^r), whichever has no cancellation.  The
  // outgoing tetrad is the mirror image of rain with the opposite signs of u^r and w.
  static double radial_celerity(double r, double radial, double energy, double squares,
                                bool outgoing) {
    const double s = free_fall_speed(r), inward = outgoing ? radial : -radial;
    const double w =
        inward >= 0 ? squares / (s * energy + inward) : (s * energy - inward) / lapse_squared(r);
    return outgoing ? -w : w;
  }

  // The same of what moves with l = r dphi/dtau and E > 0, for which (1 - E^2) + l^2 is
  // (2/r)(1 + l^2) - (u^r)^2.
  static double moving_celerity(double r, double radial, double l, bool outgoing) {
    const double energy = std::sqrt(radial * radial + lapse_squared(r) * (1 + l * l));
    return radial_celerity(r, radial, energy, 2 / r * (1 + l * l) - radial * radial, outgoing);
  }

  // Returns r* = r + 2 ln|r/2 - 1|, with which v = t + r* and u = t - r* are the times of light that
  // falls and that rises.  [Riazuelo] eq. def_rstar.  It is 0 at r = 0, where it is -r^2/4 to first
  // order and keeps its digits, and -infinity at r = 2.
  static double tortoise(const Radius& at);

  // Returns the r* of r, outside the horizon, less that of `at`, which does not cancel beside it.
  static double tortoise_from(const Radius& at, double r) {
    return r - at.r + 2 * std::log((r - 2) / at.above_horizon);
  }

  // Returns r* for pixels, by a logarithm of their own.  On the horizon, where r* is infinite, a
  // finite number stands for it.
  template <class Logarithm>
  static double finite_tortoise(double r, const Logarithm& logarithm) {
    constexpr double kLeast = 1e-9;
    const double above = r / 2 - 1;
    return r + 2 * logarithm(above < kLeast ? kLeast : above);
  }

  // Says which of the skies I and III are seen at r of a region, where light is bent.  No light of
  // either enters region IV.  The sky that is not the tetrad's own is seen inside the future
  // horizon only.
  static constexpr PerSky<bool> seen_skies(Region region, Tetrad tetrad, int universe, double r) {
    const bool own = region != Region::kIV, other = region == Region::kII && r < 2;
    PerSky<bool> seen;
    seen[own_sky(tetrad, universe)] = own;
    seen[own_sky(mirror_of(tetrad), universe)] = other;
    return seen;
  }
};

}  // namespace domefall
