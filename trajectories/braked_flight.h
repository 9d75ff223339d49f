// A BrakedFlight is that of an observer with engines who comes straight in and is at rest at
// stop_r, where it hovers from then on.  Against the static observer at r its rapidity is
//
//   psi(r) = psi_0 ((r - r_1)/(r_0 - r_1))^(2/3)
//
// from r_0 = from_r to r_1 = stop_r.  So r - r_1 falls like the cube of the time that is left, and
// the felt acceleration d(sqrt(f) cosh psi)/dr, with f = lapse_squared(r), is finite throughout and
// goes over into that of hovering, d(sqrt(f))/dr, without a jump.  The states are exact to rounding for
// their r.  Proper time and null time are quadratures (flight_table.h).  tau = 0 at from_r.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class BrakedFlight {
 public:
  // Takes horizon() < stop_r < from_r (M), and the speed at from_r against the static observer, 1e-6
  // to below 1.  Throws std::domain_error that names the bound.
  BrakedFlight(double from_r, double stop_r, double speed,
               const Spacetime& spacetime = Schwarzschild{});

  // Returns the proper time from from_r to the stop, in M.
  double duration() const;
  // Returns the point for tau >= 0, and throws std::domain_error elsewhere.  null_time counts from
  // from_r.
  OrbitPoint at(const ProperTime& tau) const;
  static double birth();  // the neighbour of 0, which still belongs to the flight
  static double death() { return kInfinity; }
  // Returns the proper time at which r is passed, or reached in the end, if that is not before
  // `after`.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
