// A ChargedOrbit is any timelike geodesic of what has no charge near a charged hole, by proper time
// (charged_turns.h).  The charge repels at last, so that every orbit has a periastron, and none meets
// the singularity.  Where it lies outside the horizon, or where there is none, the orbit comes from
// infinity and goes back, or is bound, and its states are given in rain.  Where it lies inside the
// inner horizon, the orbit goes through I, II and V to the periastron, in rain, and by V and IV into
// region I of the next universe, in the outgoing tetrad.  A bound one does so in each period.
//
//   scattered  r = r_p cosh^2 s                    bound  r = r_p + (r_a - r_p) sin^2(s/2)
//
// tau = 0, azimuth 0 and t = 0 are at the periastron, so that r is even in tau and azimuth odd.  For
// falls and throws they are at the given place instead.  What rises from there outside of a hole is
// given in rain up to its next periastron.
// Proper time, azimuth and null time are quadratures (flight_table.h), made once.  Orbits beyond r =
// 1e10 M are not tabulated.
//
// The factories throw std::domain_error, which begins with the name of what is out of bounds, for an
// orbit that does not exist.  E^2 - 1 is `excess_energy`, and L >= 0 is in M.  What an `excess` is
// added to is a bound beyond which an orbit falls into the hole.  A naked singularity has no such
// bounds and no excess.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "trajectories/charged_turns.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class ChargedOrbit {
 public:
  // ---- from infinity and back ----
  static ChargedOrbit by_periastron(const ChargedHole& hole, double r, double excess_energy);
  static ChargedOrbit scattered(const ChargedHole& hole, double excess_energy, double l);
  // L is its bound times 1 + excess.
  static ChargedOrbit by_momentum_excess(const ChargedHole& hole, double excess_energy,
                                         double excess);
  // The speed at infinity is the least that turns at r, times 1 + excess.
  static ChargedOrbit by_speed_excess(const ChargedHole& hole, double r, double excess);

  // ---- bound: r = p/(1 + e cos x) ----
  static ChargedOrbit between(const ChargedHole& hole, double periastron, double apoastron);
  static ChargedOrbit by_shape(const ChargedHole& hole, double p, double e);
  // p is its bound plus excess.
  static ChargedOrbit by_shape_excess(const ChargedHole& hole, double e, double excess);

  // ---- falls and throws, with tau = 0 at r ----
  static ChargedOrbit from_rest(const ChargedHole& hole, double r, double l);
  static ChargedOrbit falling(const ChargedHole& hole, double r, double excess_energy, double l);
  // Thrown with this celerity against what rests at r, or against the tetrad T.  If the energy
  // against T is negative, the orbit is that of the opposite energy, mirrored, which
  // has_negative_energy() tells.
  static ChargedOrbit thrown(const ChargedHole& hole, double r, double radial, double tangential);
  static ChargedOrbit thrown_from_tetrad(const ChargedHole& hole, double r, double radial,
                                         double tangential);
  static bool has_negative_energy(const ChargedHole& hole, double r, double radial,
                                  double tangential);
  // Falls from 1/r = 1/circle + over with the L of the circle at r = circle, and an E^2 that exceeds
  // the circle's by more >= 0.
  static ChargedOrbit off_circle(const ChargedHole& hole, double circle, double over, double more);

  double energy() const;
  double angular_momentum() const;  // M
  double innermost() const;         // M
  double outermost() const;         // M, or infinity
  bool passes() const;              // through the horizons

  OrbitPoint at(const ProperTime& tau) const;
  double birth() const;
  double death() const;
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::optional<ProperTime> next_periastron(const ProperTime& after) const;
  std::pair<double, double> reach() const { return {innermost(), outermost()}; }
  double radial_period() const;  // infinity for what is not bound

 private:
  struct Tables;

  explicit ChargedOrbit(const ChargedTurns& turns);
  // Returns the orbit with tau = 0 where it is `above` its periastron and `below` its apoastron, on a
  // leg.
  static ChargedOrbit counted_from(const ChargedTurns& turns, double above, double below, Leg leg);

  OrbitPoint own_point(const ProperTime& own) const;

  std::shared_ptr<const Tables> tables_;
  // These are of tau = 0, counted from the periastron.
  ProperTime start_ = 0;
  double start_azimuth_ = 0;
  DoubleDouble start_null_time_{};
  int start_universe_ = 0;
  bool rises_ = false;
};

// A ChargedCircle is a geodesic circular orbit (circling_time() of charged.h).
struct ChargedCircle {
  ChargedHole hole;
  double r;

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
};

// Returns the proper time of one revolution, M.
double period(const ChargedCircle& orbit);

}  // namespace domefall
