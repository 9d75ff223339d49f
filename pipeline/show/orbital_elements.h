// OrbitalElements give the orbit of a body as astronomers publish that of one star about another.
#pragma once

#include "pipeline/show/body.h"

namespace domefall {

// The elements are those of visual binaries, and of the stars about Sagittarius A* (Gillessen
// et al. 2009, ApJ 692, 1075; 2017, ApJ 837, 30).  Angles are in radians.
struct OrbitalElements {
  double period;        // of the ellipse, M
  double eccentricity;  // [0, 1)
  double inclination;   // of its plane to that of the sky: 0 counter-clockwise, pi clockwise
  double node;          // position angle, from north through east, where the body recedes
  double pericentre;    // from the node, in the sense of the motion
};

// Lays the orbit into space as it is seen along `line_of_sight`.  Sets the trajectory, whose tau is
// 0 at the pericentre, its plane, and the azimuth of the pericentre.  The semilatus rectum is
// p = a (1 - e^2), where a is Kepler's, a^3 = (period/2 pi)^2.  From pericentre to pericentre the
// orbit therefore takes longer than the period by a part of about 3/a.  Throws std::domain_error
// where the trajectory does (bound_orbit.h).
void set_orbit(const OrbitalElements& elements, const SkyDirection& line_of_sight, Body& body);

}  // namespace domefall
