// A trajectory is a small value that says where the observer is, and how it moves, at proper time
// tau.  There is one header per kind, and this one makes them exchangeable.  Each kind answers
//
//   at(tau)                                       its point
//   held_radius()                                 r, if it stays there for ever
//   birth(), death(), time_at(), reach()          when it is where, if it does not stay
//   next_periastron(), radial_period(), is_at_rest(), time_at_l()
//                                                 if it knows better than the defaults below
//
// A kind that answers neither the second line nor the third does not compile.
#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "trajectories/accelerated_path.h"
#include "trajectories/braked_flight.h"
#include "trajectories/charged_orbit.h"
#include "trajectories/circular_orbit.h"
#include "trajectories/geodesic.h"
#include "trajectories/given_velocity.h"
#include "trajectories/infinity.h"
#include "trajectories/kerr_flight.h"
#include "trajectories/kerr_orbit.h"
#include "trajectories/orbit_point.h"
#include "trajectories/radial_infall.h"
#include "trajectories/speed_ramp.h"
#include "trajectories/spiral.h"
#include "trajectories/static_observer.h"
#include "trajectories/wormhole_path.h"

namespace domefall {

using Trajectory =
    std::variant<StaticObserver, CircularOrbit, RadialInfall, GivenVelocity, SpeedRamp, Geodesic,
                 AcceleratedPath, Spiral, BrakedFlight, ChargedOrbit, ChargedCircle, WormholeCircle,
                 WormholeFall, WormholeFlight, KerrOrbit, KerrCircling, KerrFlight>;

// Returns the point of the orbit at proper time tau (units of M, or seconds in flat space) since
// its start.  tau must be in (birth, lifetime), for a radial infall in [0, lifetime).
OrbitPoint point_at(const Trajectory& trajectory, const ProperTime& tau);

// Returns the proper time after which the trajectory begins.  It is that of the past singularity,
// or just before the first key of a path, and -infinity without either.
double birth(const Trajectory& trajectory);

// Returns the proper time before which the trajectory ends.  It ends at the singularity, or just
// behind the last key of a path.  For an observer whose time does not end this is infinity.
double lifetime(const Trajectory& trajectory);

// Returns the first proper time >= after at which r (M) is passed on that leg.  Returns nothing if
// it never is, or if r does not change.
std::optional<ProperTime> time_at(const Trajectory& trajectory, double r, Leg leg,
                                  const ProperTime& after = -kInfinity);

// Returns the first proper time >= after at which l of a wormhole is passed.  By default it never is.
std::optional<ProperTime> time_at_l(const Trajectory& trajectory, double l,
                                    const ProperTime& after = -kInfinity);

// Returns the smallest and the largest r of its whole life, in M.
std::pair<double, double> reach(const Trajectory& trajectory);

// Returns the first proper time >= after of a periastron that is known in closed form.  By default
// there is none.
std::optional<ProperTime> next_periastron(const Trajectory& trajectory, const ProperTime& after);

// Returns the proper time after which r repeats itself.  By default it never does: infinity.
double radial_period(const Trajectory& trajectory);

// Says whether the observer rests in the static frame for ever, to rounding.  By default it moves.
bool is_at_rest(const Trajectory& trajectory, const Spacetime& spacetime);

}  // namespace domefall
