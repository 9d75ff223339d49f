// A trajectory is a small value that says where the observer is, and how it moves, at proper time
// tau.  There is one header per kind, and this one makes them exchangeable.
#pragma once

#include <variant>

#include "trajectories/accelerated_path.h"
#include "trajectories/circular_orbit.h"
#include "trajectories/geodesic.h"
#include "trajectories/given_velocity.h"
#include "trajectories/orbit_point.h"
#include "trajectories/radial_infall.h"
#include "trajectories/speed_ramp.h"
#include "trajectories/static_observer.h"

namespace domefall {

using Trajectory = std::variant<StaticObserver, CircularOrbit, RadialInfall, GivenVelocity,
                                SpeedRamp, Geodesic, AcceleratedPath>;

// Returns the point of the orbit at proper time tau (units of M, or seconds in flat space) since
// its start.  tau must be in [0, lifetime).  For a geodesic it must be in (birth, death), and for a
// path from its first key to its last.
OrbitPoint point_at(const Trajectory& trajectory, const ProperTime& tau);

// Returns the proper time before which the trajectory ends.  It ends at the singularity, or just
// behind the last key of a path.  For an observer whose time does not end this is infinity.
double lifetime(const Trajectory& trajectory);

}  // namespace domefall
