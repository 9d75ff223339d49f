// A Camera says how the frames of a show are oriented.
#pragma once

#include <memory>
#include <variant>

#include "pipeline/show/body.h"
#include "projections/projection.h"
#include "trajectories/directions.h"

namespace domefall {

// Euler angles turn the boosted (Theta, Phi, R), called (A, B, C), by phi about C, by vartheta
// about the new B and by psi about the new C, in radians.  [Riazuelo] sec. sec_cam.
struct EulerAngles {
  double phi = 0, vartheta = 0, psi = 0;
};
struct LookAtHole {};
struct LookOutward {};      // away from the hole
struct LookAlongMotion {};  // against the static frame, continued smoothly inside the horizon
// LookAtSky looks at the primary image, lensing included, of a place on the own sky of the
// observer's tetrad (own_sky).
struct LookAtSky {
  SkyDirection target;
};
struct LookAtBody {  // at the direct image of a body, or at the hole where there is none
  std::shared_ptr<const Body> body;
};
using Attitude =
    std::variant<LookAtHole, LookAlongMotion, LookAtSky, EulerAngles, LookOutward, LookAtBody>;

// What a camera's direction is kept against: its target, or, from where the motion begins, gyroscopes or
// the far stars (carried_camera.h).
enum class CameraFrame { kHole, kGyroscope, kStars };

struct Camera {
  Attitude attitude = LookAtHole{};
  CameraFrame frame = CameraFrame::kHole;
  // The image is turned clockwise by `roll` (radians) about the line of sight.  Euler angles do not
  // use it.
  double roll = 0;
  // A target stands `elevation` (radians) above the dome's front rim.  Only projections with a
  // zenith use it.
  double elevation = 0;
  // The theatre's dome leans by `dome_tilt` (radians) towards the front.  An image with a zenith
  // is turned so that what stood at elevation e stands at e + dome_tilt.
  double dome_tilt = 0;
};

// Returns a rotation whose columns are the directions, along the camera's axes, in which those who
// look at a frame find their right, their front and their zenith.  In a dome the front is the
// bottom of the image and the zenith its middle, but for the tilt (radians) of the dome.  In a flat
// image the front is the middle and the zenith is up.
M33d audience_axes(const Projection& projection, double dome_tilt);

}  // namespace domefall
