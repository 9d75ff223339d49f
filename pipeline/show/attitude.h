// From what a camera looks at to its axes.
#pragma once

#include <optional>

#include "pipeline/show/show.h"
#include "projections/projection.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The camera axes (columns X, Y, Z in the boosted tetrad) for an observer that is otherwise
// complete.  A flat projection puts the target in the middle; a Domemaster puts it `elevation` above
// the front of the rim.  Without aberration the tetrad is that of the observer at rest (vantage.h).
M33d camera_axes(const Camera& camera, const Projection& projection, const ObserverState& observer,
                 const Effects& effects = {});

// Where the target appears in the picture, in the same tetrad; nothing for Euler angles.
std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& observer,
                                    const Effects& effects = {});

// The direction (boosted tetrad) in which an observer moves against the static frame, continued
// through the horizon: minus the part of the Killing vector d/dt that is orthogonal to u.  Zero
// length if the observer is static.
V3d motion_direction(const ObserverState& observer);

// The rotation vector (axis times angle, in what the cameras' axes are given in) that turns `from` into
// `to`; of its representations, whole turns apart, the nearest to `before`.
V3d turn_between(const M33d& from, const M33d& to, const V3d& before);

// The axes that such a turn leads to.
M33d turned_by(const M33d& from, const V3d& turn);

}  // namespace domefall
