// The axes of a camera from what it looks at.
#pragma once

#include <optional>

#include "pipeline/show/show.h"
#include "projections/projection.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The camera axes X, Y and Z, as columns in the boosted tetrad, for an observer that is otherwise
// complete.  A flat projection puts the target in the middle of the image; one with a zenith puts
// it `elevation` above the front of the rim.  Without aberration the tetrad is that of the observer
// at rest (vantage.h).
M33d camera_axes(const Camera& camera, const Projection& projection, const ObserverState& observer,
                 const Effects& effects = {});

// The direction in which the target is seen, in the same tetrad.  Euler angles have no target.
std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& observer,
                                    const Effects& effects = {});

// The direction in which an observer moves against the static frame, in the boosted tetrad: minus
// the part of the Killing vector d/dt that is orthogonal to u.  It goes on through the horizon.
// Its length is 0 if the observer is static.
V3d motion_direction(const ObserverState& observer);

// The rotation vector (axis times angle in radians, in the basis of the cameras' axes) that turns
// `from` into `to`.  Of the vectors that do so, which differ by whole turns, it is the nearest to
// `before`.
V3d turn_between(const M33d& from, const M33d& to, const V3d& before);

// The axes that such a rotation vector leads to.
M33d turned_by(const M33d& from, const V3d& turn);

}  // namespace domefall
