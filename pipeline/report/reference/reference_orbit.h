// reference_leg() computes geodesics of massive bodies with 50 digits, as the truth for
// trajectories.  The radial speed u follows from the norm of the four-velocity,
// E^2 = u^2 + (1 - 2/r)(1 + L^2/r^2), so
//
//     u^2 = (E^2 - 1) + 2/r - L^2/r^2 + 2 L^2/r^3    tau = int dr/|u|    phi = int L dr/(r^2 |u|)
//
// The integrals are taken over x with r = r_0 +- x^2.  The place r_0 may be a turning point,
// because dr/|u| is regular in x there.  Trajectories use other parameters, so the two share no
// formula.  Differences may cancel, since enough of the 50 digits remain.
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

// Returns the orbit that turns at both radii.  If `far` is infinite, E = 1.
ReferenceOrbit orbit_between(const Real50& near, const Real50& far);

// Returns the places at `radii`, which lead one way from r = from, inwards or outwards.  tau and
// azimuth are 0 there.  Near a turning point at `from` the differences r - from should form a
// geometric series, and near 0 the radii themselves.  If each is at most twice the one before, the
// error is below 1e-20.
std::vector<ReferencePlace> reference_leg(const ReferenceOrbit& orbit, const Real50& from,
                                          const std::vector<Real50>& radii);

}  // namespace domefall
