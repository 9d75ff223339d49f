// The granules of a star's surface, where gas that is hot rises and gas that has cooled sinks in dark
// lanes between them.
//
// The Sun's are 1.3 Mm wide, 0.002 of its radius, and their rms contrast in the visible is 0.12 or so
// (Nordlund, Stein and Asplund 2009, Living Rev. Solar Phys. 6, 2).  No dome resolves that on a star
// which it shows as a whole.  Here they are nine times as wide, a fine grain on a star that fills a
// quarter of a dome, with a mottling a little wider than the Sun's supergranules.
#pragma once

#include "trajectories/directions.h"

namespace domefall {

inline constexpr double kGranule = 0.018, kMottling = 0.06;  // widths, in radii

// Returns the light of a place of the unit sphere over the mean, which is 1 to 1e-3.  `contrast` is
// the standard deviation of the granules.  The light is that of `width` about the place (radii): what
// is finer than twice that is left out, and where nothing is left it is 1.
double granulation(const V3d& place, double width, double contrast);

}  // namespace domefall
