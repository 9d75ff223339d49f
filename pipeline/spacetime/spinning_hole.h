// A SpinningHole is a KerrHole in space: with its mass, and an axis about which it turns.
//
// What a Spacetime asks its kind depends here on the latitude, too.  Where it is asked for an r alone,
// that of the axis is given, on which nothing is dragged along.  Who rests is there who has no angular
// momentum, and turns with the hole (kerr_orbit.h).
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/spacetime/kerr.h"
#include "pipeline/spacetime/regions.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

struct SpinningHole {
  double mass_solar = 1;
  KerrHole kerr;
  // A unit vector on the celestial sphere, equatorial J2000: seen from its tip, the hole turns
  // counter-clockwise.
  std::array<double, 3> axis{0, 0, 1};

  bool operator==(const SpinningHole&) const = default;

  std::optional<double> solar_masses() const { return mass_solar; }
  double seconds_per_m() const { return mass_solar * kSecondsPerSolarMass; }
  std::vector<double> parameters() const;
  double horizon() const { return static_cast<double>(kerr.horizon()); }
  double inner_horizon() const { return static_cast<double>(kerr.inner_horizon()); }
  double above_horizon(double r) const { return static_cast<double>(r - kerr.horizon()); }
  // These are of the equator and in the sense of the spin.
  double light_circle() const { return kerr_light_circle(kerr, true); }
  double last_stable_orbit() const { return last_stable_circle(kerr, true); }
  double circling_time(double r) const {
    const auto circle = kerr_circle(kerr, r, true);
    return circle ? 1 / (r * circle->angle) : std::nan("");
  }
  double lapse_squared(double r) const {
    const auto a = static_cast<double>(kerr.spin);
    return static_cast<double>(kerr.delta(r)) / (r * r + a * a);
  }
  double lapse_squared_above(double r, double) const { return lapse_squared(r); }
  StaticTime static_time(double r) const {
    const double f = lapse_squared(r);
    return {(1 + f) / 2, (1 - f) / 2};
  }
  double resting_celerity(double r) const {
    const double f = lapse_squared(r);
    return (1 - f) / (2 * std::sqrt(std::abs(f)));
  }
  double fall_celerity(double r) const;
  double moving_celerity(double r, double radial, double tangential, bool outgoing) const;
  double tortoise(double r) const { return static_cast<double>(kerr.tortoise(r)); }
  static PerSky<bool> seen_skies(Region region, Tetrad, int, double) {
    PerSky<bool> seen;
    seen[SkyRegion::kI] = true;
    seen[SkyRegion::kIII] = region == Region::kII;
    return seen;
  }
};

}  // namespace domefall
