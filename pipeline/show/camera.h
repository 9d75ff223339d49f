// How a camera is oriented.
#pragma once

#include <memory>
#include <variant>

#include "pipeline/show/body.h"
#include "projections/projection.h"
#include "trajectories/directions.h"

namespace domefall {

// Rotations of the boosted (Theta, Phi, R) by phi about C, vartheta about B' and psi about C', in
// radians.  [Riazuelo] sec. sec_cam.
struct EulerAngles {
  double phi = 0, vartheta = 0, psi = 0;
};
struct LookAtHole {};
struct LookOutward {};      // away from the hole
struct LookAlongMotion {};  // against the static frame, continued smoothly inside the horizon
struct LookAtSky {          // at the primary image of a place on sky I, lensing included
  SkyDirection target;
};
struct LookAtBody {  // at the direct image of a body, or at the hole where there is none
  std::shared_ptr<const Body> body;
};
using Attitude =
    std::variant<LookAtHole, LookAlongMotion, LookAtSky, EulerAngles, LookOutward, LookAtBody>;

struct Camera {
  Attitude attitude = LookAtHole{};
  // Radians about the line of sight, clockwise on the image.  Euler angles do not use it.
  double roll = 0;
  // Radians above the dome's front rim at which a target stands.  Only pictures with a zenith use
  // it.
  double elevation = 0;
  // Radians by which the theatre's dome leans towards the front.  A picture with a zenith is
  // turned so that what stood at elevation e stands at e + dome_tilt.
  double dome_tilt = 0;
};

// Where those who look at a picture find their right, their front and their zenith: columns along
// the camera's axes, a rotation.  In a dome the front is the bottom of the image and the zenith its
// middle, but for the tilt (radians) of the dome; on a flat picture the front is its middle and the
// zenith up.
M33d audience_axes(const Projection& projection, double dome_tilt);

}  // namespace domefall
