// A trajectory is a small value that answers one question: where is the observer, and how does it
// move, at proper time tau.  One header per kind; this one makes them exchangeable.
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

// The point of the orbit at proper time tau (units of M; seconds in flat space) since its start.
// tau must be in [0, lifetime), of a geodesic in (birth, death), of a path on it.
OrbitPoint point_at(const Trajectory& trajectory, const ProperTime& tau);

// The proper time before which the trajectory ends: at the singularity, or just behind the last key
// of a path; infinity for an observer whose time does not end.
double lifetime(const Trajectory& trajectory);

}  // namespace domefall
