// A Spiral is that of an observer on a free circular orbit who lets go of it and falls into the
// hole.  It has three parts, which follow each other with no jump of the velocity or of the felt
// acceleration.
//
//   circle   the free orbit at from_r; only from r < 6 M, where an orbit whirls of itself, is it
//            more than the instant tau = 0
//   push     with engines.  1/r is a quintic of the azimuth.  The angular momentum is that of the
//            free orbit at each r > 6 M, and from 6 M inward, or from r_c = from_r < 6 M, that of
//            the orbit there
//   fall     free, to the singularity.  From r_c <= 6 M it is the orbit that has come off the
//            circle at r_c in the infinite past; from 6 M, r = 6/(1 + 12/(phi_0 - phi)^2)
//            (Mummery and Balbus 2022)
//
// Whoever starts above 6 M shrinks the circle by the push, which takes most of the turns, and the
// engines stop a little below 6 M.  The turns are those from tau = 0 to r = 2 M.  Near a charge,
// last_stable_orbit() and the horizon stand for 6 M and 2 M, and the fall does not end.
//
// The states are exact to rounding for their r.  Azimuths keep to 1e-12 of the whole, or 1e-10
// where from_r is above 6 M by less than 0.001 M.  Proper time and null time are quadratures
// (flight_table.h, geodesic.h).
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class Spiral {
 public:
  static constexpr double kFewestTurns = 0.5, kMostTurns = 1000;

  // Takes from_r > light_circle() (M) of a hole.  Throws std::domain_error that names the bound.
  Spiral(double from_r, double turns, const Spacetime& spacetime = Schwarzschild{});

  // Returns the point for tau < death().  Before tau = 0 the observer is on the circle.
  OrbitPoint at(const ProperTime& tau) const;
  static double birth() { return -kInfinity; }
  // Returns the proper time of the singularity, rounded, or infinity near a charge.  at() counts from
  // the rounded one.
  double death() const;
  // These return the proper times at which the engines start and stop.
  double pushed() const;
  ProperTime released() const;
  // Returns the proper time at which r is passed; from_r is passed when the engines start.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
