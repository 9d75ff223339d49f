// Circles about the axis through the hole, as an observer in motion sees them.
#pragma once

#include <vector>

#include "pipeline/optics/half_angle.h"
#include "pipeline/optics/hole_optics.h"
#include "trajectories/observer_state.h"

namespace domefall {

// The directions n, of the camera's axes, with n.axis = cosine.
struct ViewCircle {
  V3d axis;  // unit vector
  double cosine, sine;
};

// The circle whose angle in the reference tetrad counts from the direction of the hole or, for the
// outgoing tetrad, from the opposite one (alpha of null_ray.h).  An observer with gamma v
// `celerity` against the tetrad sees a circle, too, since a boost makes circles of circles.
ViewCircle view_circle(const HalfAngle& alpha, const ObserverState& observer, const V3d& celerity);

// The silhouette: the edges of the skies that are seen, outside one, inside two, in region IV and
// flat space none.
std::vector<ViewCircle> silhouette_circles(const ObserverState& observer, const V3d& celerity);

// Where what lies straight behind the hole is seen: light that has swept an azimuth of pi, one
// circle for each sky that is seen.  It makes its tables anew, in half a millisecond.
std::vector<ViewCircle> einstein_circles(const ObserverState& observer, const V3d& celerity);

}  // namespace domefall
