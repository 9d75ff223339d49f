// A ChargedOrbit is any timelike geodesic of what has no charge near a charged hole, by proper time.
// With w = 1/r
//
//   (dr/dtau)^2 = P(w) = (E^2 - 1) + 2w - (q^2 + L^2) w^2 + 2 L^2 w^3 - q^2 L^2 w^4
//
// The charge repels at last, so that every orbit has a periastron, and none meets the singularity.
// Where it lies outside the horizon, the orbit comes from infinity and goes back, or is bound, and
// its states are given in rain.  Where it lies inside the inner horizon, the orbit goes through I,
// II and V to the periastron, in rain, and by V and IV into region I of the next universe, in the
// outgoing tetrad.  A bound one does so in each period.
//
//   scattered  r = r_p cosh^2 s                    bound  r = r_p + (r_a - r_p) sin^2(s/2)
//
// tau = 0, azimuth 0 and t = 0 are at the periastron, so that r is even in tau and azimuth odd.
// Proper time, azimuth and null time are quadratures (flight_table.h), made once.  Orbits beyond r =
// 1e10 M are not tabulated.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "pipeline/spacetime/charged.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class ChargedOrbit {
 public:
  // These throw std::domain_error, which begins with the name of what is out of bounds, for an orbit
  // that does not exist.

  // Takes E^2 - 1 and L >= 0 (M), and goes where r (M) is passed.
  static ChargedOrbit through(const ChargedHole& hole, double r, double excess_energy, double l);
  // These have a turning point at r: at rest there, with L, or with E^2 - 1.
  static ChargedOrbit from_rest(const ChargedHole& hole, double r, double l);
  static ChargedOrbit by_periastron(const ChargedHole& hole, double r, double excess_energy);
  static ChargedOrbit between(const ChargedHole& hole, double periastron, double apoastron);

  double energy() const;
  double angular_momentum() const;  // M
  double innermost() const;         // M
  double outermost() const;         // M, or infinity
  bool passes() const;              // through the horizons

  OrbitPoint at(const ProperTime& tau) const;
  double birth() const;
  double death() const { return -birth(); }
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::optional<ProperTime> next_periastron(const ProperTime& after) const;
  std::pair<double, double> reach() const { return {innermost(), outermost()}; }
  double radial_period() const;  // infinity for what is not bound

 private:
  struct Tables;

  explicit ChargedOrbit(std::shared_ptr<const Tables> tables) : tables_(std::move(tables)) {}
  static ChargedOrbit with_roots(const ChargedHole& hole, double excess_energy, double l,
                                 double periastron, double w1);

  std::shared_ptr<const Tables> tables_;
};

// A ChargedCircle is a geodesic circular orbit, with L^2 = r^2 (r - q^2)/D and E = Delta/(r sqrt D),
// D = r^2 - 3r + 2q^2.
struct ChargedCircle {
  ChargedHole hole;
  double r;  // above r_c and q^2

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
};

// Returns the proper time of one revolution, M.
double period(const ChargedCircle& orbit);

}  // namespace domefall
