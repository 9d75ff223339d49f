// These functions find the axes of a camera from what it looks at.
#pragma once

#include <optional>

#include "pipeline/show/show.h"
#include "projections/projection.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Returns the camera axes X, Y and Z, as columns in the boosted tetrad, for an observer whose state
// is complete except for its camera.  A flat projection puts the target in the middle of the image.
// A projection with a zenith puts it `elevation` above the front of the rim.  Without aberration
// the tetrad is that of the observer at rest (viewer.h).
M33d camera_axes(const Camera& camera, const Projection& projection, const ObserverState& observer,
                 const Effects& effects = {});

// Returns the axes that Euler angles and the cameras of other programs count from, as columns in the
// boosted tetrad.  They are its R, Theta and Phi.  Near a charge R stands midway between the
// directions in which light from outside and from the hole comes along R, in the plane of both.  These
// do not depend on the tetrad, so that nothing turns where an observer inside goes from one to the
// other.
M33d base_axes(const ObserverState& observer);
// Returns the axes of the observer's camera along these.
M33d base_from_camera(const ObserverState& observer);

// Returns the angles of a camera that is turned by them, and for a dome that does not lean, from its
// axes along those of base_axes().
EulerAngles euler_angles_of(const M33d& base_from_camera);

// Returns the axes of a dome that stands upright where another leans to its front by `tilt`
// (radians), which a show adds again to the angles of its camera.
M33d untilted(const M33d& axes, double tilt);

// Returns the direction in which the target is seen, in the same tetrad.  Euler angles have no
// target, so that nothing is returned for them.
std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& observer,
                                    const Effects& effects = {});

// Returns the direction in which an observer moves against the static frame, in the boosted tetrad.
// It is minus the part of the Killing vector d/dt that is orthogonal to u, so that it continues
// smoothly through the horizon.  Its length is 0 if the observer is static.
V3d motion_direction(const ObserverState& observer);

// Returns the rotation vector that turns `from` into `to`: the axis times the angle in radians, in
// the basis in which the axes are given.  Rotation vectors that differ by whole turns have the same
// effect, and the one nearest to `before` is returned.
V3d turn_between(const M33d& from, const M33d& to, const V3d& before);

// Returns the axes into which such a rotation vector turns `from`.
M33d turned_by(const M33d& from, const V3d& turn);

}  // namespace domefall
