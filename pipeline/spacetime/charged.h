// The spacetime of a charge, Reissner's and Nordstrom's, in units of its mass, M = c = G = 1:
//
//     ds^2 = f dt^2 - dr^2/f - r^2 dOmega^2        f = Delta/r^2,  Delta = r^2 - 2r + q^2
//
// With a charge q < 1 there are two horizons, r_+- = 1 +- sqrt(1 - q^2), which are one at q = 1.
// With q > 1 there is none, and the singularity at r = 0 is naked.  Light circles at r_c for q^2 <=
// 9/8.  These functions are right to some roundings from r -> 0 to r = 1e8 and from q = 0, which is
// Schwarzschild's spacetime, unless they say otherwise.
//
// Frames are given against the tetrad T, which unlike rain exists at every r.  With the null
// vectors n = -d/dr and l = d/dv + (f/2) d/dr in the coordinates of light that falls, T = l + n/2
// and R = l - n/2.  Its time reversal, the outgoing tetrad T', is regular where light rises from
// the past horizon.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

// A ChargedRadius is a place, with its distances from the places that mark the hole.  Each has full
// relative accuracy, which differences of doubles would lose beside the mark.  ChargedHole makes
// it.
struct ChargedRadius {
  double r;
  // r - r_+ and r - r_-.  A naked singularity has neither; there both are r - 1.
  double above_outer, above_inner;
  // r - r_c and r - r_x.  Where light cannot circle both are r.
  double above_light_circle, above_edges;
};

// These are the places that mark the hole, from which a distance may be given.
enum class ChargedMark { kOuterHorizon, kInnerHorizon, kLightCircle };

struct ChargedHole {
  double mass_solar = 1;      // > 0; it gives one M its length and decides nothing else
  double charge = 0;          // q >= 0
  double below_extremal = 1;  // 1 - q, which next to q = 1 has digits that q has not

  bool operator==(const ChargedHole&) const = default;
  ChargedHole() = default;
  // Takes a charge q >= 0, perhaps with more digits than a double has.
  ChargedHole(double solar_masses, long double q)
      : mass_solar(solar_masses),
        charge(static_cast<double>(q)),
        below_extremal(static_cast<double>(1 - q)) {}

  std::optional<double> solar_masses() const { return mass_solar; }
  double seconds_per_m() const { return mass_solar * kSecondsPerSolarMass; }
  std::vector<double> parameters() const { return {charge, below_extremal}; }

  bool is_naked() const { return below_extremal < 0; }
  bool is_extremal() const { return below_extremal == 0; }
  bool has_light_circle() const { return nine_less_eight_squares() >= 0; }

  // Returns r_+, the r that region I lies above, or 0 for a naked singularity.
  double horizon() const { return is_naked() ? 0 : static_cast<double>(outer_horizon()); }
  double inner_horizon() const { return is_naked() ? 0 : static_cast<double>(inner_radius()); }
  double above_horizon(double r) const { return is_naked() ? r : at(r).above_outer; }
  // Returns r_c, or 0 where light cannot circle (q^2 > 9/8).
  double light_circle() const { return has_light_circle() ? static_cast<double>(circle()) : 0; }
  // Returns the least r of the stable circles that reach to infinity, the largest root of r^3 - 6
  // r^2 + 9 q^2 r - 4 q^4 = 0.  For q^2 > 5/4 all circles are stable, down to r = q^2, where bodies
  // rest.
  double last_stable_orbit() const;
  // Returns sqrt((r^2 - 3r + 2q^2)/(r - q^2)) = r/L of a free circular orbit.  Infinite at r = q^2 of
  // a naked singularity, where bodies rest.
  double circling_time(double r) const;
  // Returns q^2/2, where free fall from rest at infinity turns, since the hole repels there.
  double fall_turns_at() const { return charge * charge / 2; }
  // Returns kappa, the b = L/E of the light that circles.  Light must be able to circle.
  double critical_impact() const { return static_cast<double>(kappa()); }
  // Returns r_x, below which no light with b = kappa passes.  It is below r_-.
  double edges_end() const { return has_light_circle() ? static_cast<double>(edges_radius()) : 0; }

  ChargedRadius at(long double r) const;
  // Returns the place at a distance, with full relative accuracy, from a mark.
  ChargedRadius at(ChargedMark mark, double distance) const;

  // Returns s = sqrt(2r - q^2)/r, the speed of free fall from rest at infinity against observers at
  // rest.  It exceeds 1 between the horizons.  r >= q^2/2.
  double free_fall_speed(double r) const { return std::sqrt(2 * (r - fall_turns_at())) / r; }
  // Returns Delta and f, of either sign.
  long double delta(const ChargedRadius& at) const;
  double lapse_squared(const ChargedRadius& at) const;
  double lapse_squared(double r) const { return lapse_squared(at(r)); }
  double lapse_squared_above(double r, double above) const {
    return lapse_squared(is_naked() ? at(r) : at(ChargedMark::kOuterHorizon, above));
  }

  StaticTime static_time(double r) const {
    const double f = lapse_squared(r);
    return {(1 + f) / 2, (1 - f) / 2};
  }

  // Returns gamma v along R, against T, of what is at rest in r (f > 0) or in t (f < 0).  Against
  // T' it has the opposite sign.  Not for a horizon.
  double resting_celerity(const ChargedRadius& at) const;
  double resting_celerity(double r) const { return resting_celerity(at(r)); }
  // Returns gamma v along R, against T, of free fall from rest at infinity.  r >= q^2/2.
  double fall_celerity(double r) const;
  // Returns gamma v along R that a motion has in T, or in T', from u^r = dr/dtau, its energy E and
  // l^2, where l = r dphi/dtau.
  double radial_celerity(const ChargedRadius& at, double radial, double energy, double l2,
                         bool outgoing) const;

  // The same of what moves with l = r dphi/dtau and E > 0.
  double moving_celerity(double r, double radial, double l, bool outgoing) const {
    const ChargedRadius place = at(r);
    const double energy = std::sqrt(radial * radial + lapse_squared(place) * (1 + l * l));
    return radial_celerity(place, radial, energy, l * l, outgoing);
  }

  // Returns r*, with which v = t + r* and u = t - r* are the times of light that falls and that
  // rises.  It is 0 at r = 0, as Schwarzschild's, and is infinite on the horizons.  The error is some
  // roundings of 1 + r, and of r* below r_-/4.
  double tortoise(const ChargedRadius& at) const;
  double tortoise(double r) const { return tortoise(at(r)); }

  // Says which skies are seen from a region, where light is bent.  Those of both exteriors are seen
  // between the horizons only: beyond r_- no light of the other one arrives.  Light of the universe
  // before comes through the inside.
  PerSky<bool> seen_skies(Region region, Tetrad tetrad, int universe, double) const {
    const Tetrad other = mirror_of(tetrad);
    const bool rising = region == Region::kIV, falling = region == Region::kII;
    const bool within = region == Region::kV || region == Region::kVI;
    const bool through = universe > 0 && charge > 0 && !is_naked();
    PerSky<bool> seen;
    seen[own_sky(tetrad, universe)] = !rising;
    if (falling) seen[own_sky(other, universe)] = true;
    if (through && !falling && !within) seen[own_sky(tetrad, universe - 1)] = true;
    if (through && rising) seen[own_sky(other, universe - 1)] = true;
    return seen;
  }

  // CriticalTangents are tan(delta/2) of the rays in T that have |L/E| = kappa: tau_1/r and tau_2/r
  // of the energy E > 0, which are of E < 0 with the opposite signs.  Outside r_c first < second;
  // below it first > second, and between the horizons second < 0.  Below r_x they are complex.
  struct CriticalTangents {
    bool real;
    long double first, second;  // real parts, which are equal where they are complex
    long double apart;          // second - first, or twice the imaginary part
  };
  // Light must be able to circle.
  CriticalTangents critical_tangents(const ChargedRadius& at) const;

  // These are the marks and constants to more digits than a double has.
  long double charge_long() const;               // q
  long double horizon_distance_squared() const;  // 1 - q^2 = d^2, negative for a naked singularity
  long double outer_horizon() const;             // q <= 1
  long double inner_radius() const;              // q <= 1
  long double nine_less_eight_squares() const;   // 9 - 8 q^2
  long double circle() const;
  long double kappa() const;
  long double edges_radius() const;
  long double edges_below_inner() const;  // r_- - r_x, q <= 1
};

// A PixelTortoise gives r* outside the horizon to pixels, by a logarithm of their own.  On the
// horizon, where r* is infinite, a finite number stands for it.  The error is below 1e-8.
class PixelTortoise {
 public:
  explicit PixelTortoise(const ChargedHole& hole);

  template <class Logarithm>
  double at(double r, const Logarithm& logarithm) const {
    constexpr double kLeast = 1e-9;
    const double outer = r - outer_ > kLeast ? r - outer_ : kLeast, inner = r - inner_;
    const double pole = pole_ > 0 ? pole_ / outer : 0;
    return shift_ + r + by_outer_ * logarithm(outer) + by_inner_ * logarithm(inner) - pole;
  }

 private:
  double outer_, inner_, by_outer_, by_inner_, pole_, shift_ = 0;
};

}  // namespace domefall
