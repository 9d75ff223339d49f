// Computes how an observer in motion sees circles about the axis through the hole.
#pragma once

#include <vector>

#include "pipeline/optics/half_angle.h"
#include "pipeline/optics/hole_optics.h"
#include "trajectories/observer_state.h"

namespace domefall {

// A ViewCircle consists of the directions n, along the camera's axes, with n.axis = cosine.
struct ViewCircle {
  V3d axis;  // unit vector
  double cosine, sine;
};

// Returns how the circle of all directions at the angle alpha in the reference tetrad is seen.
// alpha counts from the direction of the hole or, for the outgoing tetrad, from the opposite
// direction (null_ray.h).  The observer moves with gamma v = `celerity` against the tetrad and sees
// a circle too, since a boost turns circles into circles.
ViewCircle view_circle(const HalfAngle& alpha, const ObserverState& observer, const V3d& celerity);

// Returns the silhouette, that is, the edges of the skies that are seen.  There is one outside, two
// inside, and none in region IV or flat space.
std::vector<ViewCircle> silhouette_circles(const ObserverState& observer, const V3d& celerity);

// Returns the circles on which the point straight behind the hole is seen, by light that has swept
// an azimuth of pi.  There is one for each sky that is seen.  Each call makes its tables anew,
// which takes half a millisecond.
std::vector<ViewCircle> einstein_circles(const ObserverState& observer, const V3d& celerity);

}  // namespace domefall
