// The orbit of a body by the elements that astronomers publish for one star about another.
#pragma once

#include "pipeline/show/body.h"

namespace domefall {

// As for visual binaries, and for the stars about Sagittarius A* (Gillessen et al. 2009, ApJ 692,
// 1075; 2017, ApJ 837, 30).  Angles in radians.
struct OrbitalElements {
  double period;        // of the ellipse, M
  double eccentricity;  // [0, 1)
  double inclination;   // of its plane to that of the sky: 0 counter-clockwise, pi clockwise
  double node;          // position angle, from north through east, where the body recedes
  double pericentre;    // from the node, in the sense of the motion
};

// Lays the orbit into space as it is seen along `line_of_sight`: sets the trajectory, whose tau is
// 0 at the pericentre, its plane, and its azimuth there.  Its p is a (1 - e^2), where a is
// Kepler's, a^3 = (period/2 pi)^2, so that from pericentre to pericentre it takes longer than the
// period by a part of about 3/a.  Throws std::domain_error where the trajectory does
// (bound_orbit.h).
void set_orbit(const OrbitalElements& elements, const SkyDirection& line_of_sight, Body& body);

}  // namespace domefall
