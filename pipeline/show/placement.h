// How the plane of an orbit lies on the celestial sphere.
#pragma once

#include "trajectories/directions.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// Columns: the directions of R, Theta and Phi of the reference tetrad on the sky; a right-handed
// rotation (R x Theta = Phi).  At azimuth 0 the observer stands opposite to `hole_at`, R0 =
// -hole_at, and Phi sets out along the tangent t there that has the position angle `heading`
// (radians, from the north celestial pole through east).  At `azimuth` (radians) R and Phi have
// turned by it towards t; Theta, the south of the orbit, is -R0 x t throughout.
// A hole within 1e-12 radians of a celestial pole has no north of its own: the meridian of RA 0 at
// R0 is taken.  hole_at must have unit length.  Orthonormal to a few epsilon.
M33d place_tetrad(const SkyDirection& hole_at, double heading, double azimuth);

// The same axes after a further azimuth, in their plane.
M33d moved_on(const M33d& axes, double azimuth);

// What a segment does with the orbit of its trajectory.
struct Placement {
  bool mirrored = false;  // t -> -t: what happens in region I happens in region III
  bool backward = false;  // against the sense of Phi
  double turn = 0;  // radians from Phi through north by which its plane leaves that of the orbit
                    // before, about R
};

// The axes at the start of a segment, from those at the end of the one before.
M33d turned(const M33d& axes, double turn);

OrbitPoint placed(OrbitPoint point, const Placement& placement);

}  // namespace domefall
