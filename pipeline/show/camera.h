// Where a camera looks.
#pragma once

#include <variant>

#include "trajectories/directions.h"

namespace domefall {

// [Riazuelo] sec. sec_cam: rotations by phi about C, vartheta about B', psi about C', of the
// boosted (Theta, Phi, R).  Radians.
struct EulerAngles {
  double phi = 0, vartheta = 0, psi = 0;
};
struct LookAtHole {};
struct LookOutward {};      // away from the hole
struct LookAlongMotion {};  // against the static frame, continued smoothly inside the horizon
struct LookAtSky {          // at the primary image of a place on sky I, lensing included
  SkyDirection target;
};
using Attitude = std::variant<LookAtHole, LookAlongMotion, LookAtSky, EulerAngles, LookOutward>;

struct Camera {
  Attitude attitude = LookAtHole{};
  double roll =
      0;  // radians, about the line of sight, clockwise on the image; not with Euler angles
  double elevation = 0;  // radians above the dome's front rim at which a look-at target stands;
                         // Domemaster only
  double dome_tilt =
      0;  // radians by which the theatre's dome leans towards the front: the image is
          // turned so that what stood at elevation e stands at e + dome_tilt
};

}  // namespace domefall
