// These functions say how the plane of an orbit lies on the celestial sphere.
#pragma once

#include <optional>

#include "trajectories/directions.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// Returns the directions of R, Theta and Phi of the reference tetrad on the sky, as columns of a
// rotation (R x Theta = Phi).  At azimuth 0 the observer stands opposite to `hole_at`, R0 =
// -hole_at.  There Phi sets out along the tangent t whose position angle is `heading` (radians,
// from the north celestial pole through east).  At `azimuth` (radians) R and Phi have turned by it
// towards t, while Theta, the south of the orbit, stays -R0 x t.  `hole_at` must have unit length.
// A hole within 1e-12 radians of a celestial pole has no north of its own, and the meridian of RA 0
// at R0 stands in for it.  The columns are orthonormal to a few epsilon.
M33d place_tetrad(const SkyDirection& hole_at, double heading, double azimuth);

// Returns the same axes after a further azimuth (radians) in their plane.
M33d moved_on(const M33d& axes, double azimuth);

// Returns the axes about a hole that spins, at the angle theta from its axis: Theta leads away from
// the axis, and Phi around it.  The azimuth is that of other such axes, or of the Phi of an orbit, after
// a further one.
M33d moved_about(const V3d& axis, const M33d& axes, double theta, double azimuth);

// A Beginning says where and when an observer begins who does not go on from where another one
// ended.
struct Beginning {
  M33d axes;         // of the reference tetrad on the sky
  double null_time;  // of that tetrad, counted from the show's start, M
};

// A Placement is what a segment does with the orbit of its trajectory.
struct Placement {
  bool mirrored = false;  // t -> -t, so that what happens in region I happens in region III
  bool backward = false;  // it moves against the sense of Phi
  // The plane turns by this angle about R out of that of the orbit before, in radians from Phi
  // through north.
  double turn = 0;
  std::optional<Beginning> beginning{};  // none where it begins at the end of the segment before
};

// Returns the axes at the start of a segment, from those at the end of the one before and
// Placement::turn.
M33d turned(const M33d& axes, double turn);

// Returns a point of a trajectory's own orbit as the placement mirrors or reverses it.
OrbitPoint placed(OrbitPoint point, const Placement& placement);

}  // namespace domefall
