// Geodesics with 50 digits, to measure trajectories by: proper time and azimuth as integrals over r
// itself, tau = int dr/|u|, phi = int L dr/(r^2 |u|), u^2 = (E^2 - 1) + 2/r - L^2/r^2 + 2 L^2/r^3.  Along
// r = r_0 +- x^2 from a place r_0, which may be a turning point: none of the parameters of trajectories,
// and no differences that 50 digits would feel.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace domefall {

using Real50 = boost::multiprecision::cpp_bin_float_50;

struct ReferenceOrbit {
  Real50 excess_energy, angular_momentum;  // E^2 - 1, L (M)

  Real50 energy() const;
  Real50 radial_speed(const Real50& r) const;  // |dr/dtau|
};

struct ReferencePlace {
  Real50 tau, r, azimuth;
};

// The orbit that turns at both radii; E = 1 if far is infinite.
ReferenceOrbit orbit_between(const Real50& near, const Real50& far);

// The places at `radii`, which lead from r = from one way, in or out; tau = azimuth = 0 at from.  Radii
// should be spaced like a geometric series, of r - from near a turning point and of r near 0: by a factor
// of 2 the error is below 1e-20.
std::vector<ReferencePlace> reference_leg(const ReferenceOrbit& orbit, const Real50& from,
                                          const std::vector<Real50>& radii);

}  // namespace domefall
