// A wormhole joins two flat spaces, those of regions I and III, by a throat that anything can pass:
//
//     ds^2 = dt^2 - dl^2 - r(l)^2 dOmega^2       l > 0 in region I, l < 0 in region III
//
// after O. James, E. von Tunzelmann, P. Franklin and K. Thorne, arXiv:1502.03809.  l is the proper
// distance along a radius, r the radius of the sphere there, by its circumference.  Two profiles:
//
//   ellis  r^2 = l^2 + 1                                                   (their eq. 3)
//   dngr   r = 1 for |l| <= a, and 1 + m (x atan x - ln(1 + x^2)/2) beyond  (their eq. 5)
//          x = 2 (|l| - a)/(pi m)
//
// The unit of length, and with c = 1 of time, is the radius of the throat.  dngr has a cylinder of
// length 2a, beyond which it widens like a hole of mass m.  Its shape is given by the lensing width
// W, the growth of r up to where a surface like it in flat space has the slope of 45 degrees (dr/dl
// = 1/sqrt 2).  It is 1.42953 m.
//
// The domain is |l| <= 1e100, lensing_width from 1e-30 to 1e30 and length from 0 to 1e100.
// Against 50 digits all lengths here are right to 4 epsilon, and so is r - 1 next to the throat.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/spacetime/regions.h"

namespace domefall {

// This is the length in km of one second, exactly.
inline constexpr double kLightSecondKm = 299792.458;

struct Wormhole {
  enum class Profile { kEllis, kDngr };

  double radius_km =
      1;  // > 0, of the throat; it gives the unit its length and decides nothing else
  Profile profile = Profile::kEllis;
  double length = 0.01;         // 2a; only dngr has one
  double lensing_width = 0.05;  // W > 0; only dngr has one

  bool operator==(const Wormhole&) const = default;

  // W/m: t atan t - ln(1 + t^2)/2 of the t with 2 atan(t)/pi = 1/sqrt 2.
  static constexpr double kWidthOfMass = 1.4295268191803120;

  double half_length() const { return profile == Profile::kDngr ? length / 2 : 0; }  // a
  double lensing_mass() const { return lensing_width / kWidthOfMass; }               // m, of dngr
  double beyond_mouth(double l) const;  // |l| - a, 0 in the cylinder
  bool in_cylinder(double l) const { return beyond_mouth(l) == 0 && half_length() > 0; }

  // These return r - 1, r, dr/dl and d^2r/dl^2.  The last jumps where the cylinder ends; there it is
  // that of the cylinder, 0.
  double above_throat(double l) const;
  double radius(double l) const { return 1 + above_throat(l); }
  double slope(double l) const;
  double curvature(double l) const;
  double curvature_beyond(double y) const;  // the last at |l| = a + y, from outside the cylinder
  // Returns d^2r/dl^2 next to the throat's widening, 1 or 4/(pi^2 m).  Light next to the throat's
  // edge has the azimuth -ln(offset)/sqrt(this).
  double curvature_at_throat() const;
  // Returns |l| >= a of an r, given as r - 1 >= 0, so that it keeps its digits next to the throat.
  double distance(double above_throat) const;

  // The side of the throat that l is on.  The throat itself counts as region I.
  static Region side(double l) { return l < 0 ? Region::kIII : Region::kI; }

  // These answer what a Spacetime asks its kind, for r >= 1.  No horizon: everything can rest, at the
  // rate of clocks far away, and free fall from rest at infinity stays at rest.  So the rain tetrad is
  // that of rest.  Light circles at the throat.  What has mass does so as well, and nowhere stably.
  static std::optional<double> solar_masses() { return std::nullopt; }
  double seconds_per_m() const { return radius_km / kLightSecondKm; }
  std::vector<double> parameters() const;
  static constexpr double horizon() { return 0; }
  static constexpr double inner_horizon() { return 0; }
  static double above_horizon(double r) { return r; }
  static constexpr double light_circle() { return 1; }
  static constexpr double last_stable_orbit() { return 0; }
  static constexpr double circling_time(double) { return 0; }
  static StaticTime static_time(double) { return {}; }
  static double fall_celerity(double) { return 0; }
  static double lapse_squared(double) { return 1; }
  static double lapse_squared_above(double, double) { return 1; }
  static double resting_celerity(double) { return 0; }
  static double moving_celerity(double, double radial, double, bool) { return radial; }
  double tortoise(double r) const { return distance(r - 1); }  // |l|, a in the whole cylinder
  static PerSky<bool> seen_skies(Region, Tetrad, int, double) {
    PerSky<bool> seen;
    seen[SkyRegion::kI] = seen[SkyRegion::kIII] = true;
    return seen;
  }
};

// These are of the shape of dngr: G(x) = x atan x - ln(1 + x^2)/2, G(low + more) - G(low), and the
// x >= 0 with G(x) = value.  None of them cancels, for arguments from 0 to 1e150.
double flare(double x);
double flare_growth(double low, double more);
double flare_inverse(double value);

}  // namespace domefall
