// An accretion disc: thin, opaque or nearly so, in a plane through the hole of region I, of matter
// on circular orbits that glows as a blackbody.  docs/disc.md says what is drawn of it.
#pragma once

#include "trajectories/directions.h"

namespace domefall {

// The last stable circular orbit, and the horizon (units of M).
inline constexpr double kLastStableOrbit = 6, kHorizonRadius = 2;

struct Disc {
  // The radii between which there is matter, units of M.  kLastStableOrbit <= inner < outer, or
  // kHorizonRadius <= inner where it plunges.
  double inner = kLastStableOrbit, outer = 20;
  // The axis about which it turns counter-clockwise, as a direction of the celestial sphere, on
  // which the observer stands at column 0 of ObserverState::sky_from_tetrad.
  SkyDirection normal{V3d(0, 0, 1)};
  double t_max_k = 1e4;  // of the hottest ring outside the last stable orbit, in its own frame
  // Of that ring as who moves with it sees it, cd/m^2.  All other light of the disc follows.
  double luminance = 1e-3;
  double opacity = 1;  // the part of the light from behind that it takes away, 0 to 1
  // Whether matter falls in from the last stable orbit, and shines on its way.
  bool plunging = false;

  bool operator==(const Disc& other) const {
    return inner == other.inner && outer == other.outer && normal.v == other.normal.v &&
           t_max_k == other.t_max_k && luminance == other.luminance && opacity == other.opacity &&
           plunging == other.plunging;
  }
};

}  // namespace domefall
