// Motion about a hole that spins.  A KerrOrbit is any timelike geodesic of what has no charge, outside
// the inner horizon, and a KerrCircling keeps its place by whatever it takes, and turns with an even
// angular velocity.
//
// Against proper time tau a geodesic has no closed form, but over Mino time l, dtau = Sigma dl, its
// radius and its latitude move by themselves (docs/kerr.md):
//
//     r'' = R'(r)/2,                          R = P^2 - Delta (r^2 + K),  P = (r^2 + a^2) E - a L
//     N'' = -(C + 2 k N_z^2) N + k N_z z      C = K + 2aEL - a^2 E^2,     k = a^2 (E^2 - 1)
//
// and the place is the unit vector N turned about the axis by psi, psi' = a (A - E).  Both are followed
// once, by Taylor series, over a period or to the ends, and any state is a series from the nearest node.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "trajectories/infinity.h"
#include "trajectories/kerr_motion.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class KerrOrbit {
 public:
  // Starts at r > r_- and theta with that celerity against the reference tetrad, where tau, azimuth and
  // null time are 0.  Throws std::domain_error for r above 1e10, and for what comes out of the hole.
  KerrOrbit(const KerrHole& hole, double r, double theta, const KerrMotion& motion);

  OrbitPoint at(const ProperTime& tau) const;
  // The orbit ends at the inner horizon.  Before it rose from its hole it is not followed.
  double birth() const;
  double death() const;
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;
  std::optional<ProperTime> next_periastron(const ProperTime& after) const;
  double radial_period() const;

 private:
  struct Path;
  std::shared_ptr<const Path> path_;
};

struct KerrCircling {
  KerrHole hole;
  double r = 10, theta = 0, angular_velocity = 0;  // dphi/dt

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
  bool is_at_rest(const Spacetime&) const { return angular_velocity == 0; }
};

}  // namespace domefall
