// The view of an observer in a wormhole has two zones.  In each a sky is seen as a whole, infinitely
// often towards the edge that they share: the sky of the other side within the circle of the throat,
// and that of the observer's own side around it.  Angles alpha count from the direction towards the
// throat, which is -dl for l >= 0 and +dl for l < 0.  Together the zones fill 0 to pi once.
//
// A ray swept through `azimuth` comes from cos(azimuth) R + sin(azimuth) e of its sky, with R the
// observer's place and e its direction across R.  The angles of a place are common to both skies.
#pragma once

#include <array>

#include "pipeline/light/half_angle.h"
#include "pipeline/light/wormhole_azimuth.h"
#include "pipeline/spacetime/regions.h"
#include "pipeline/spacetime/wormhole.h"

namespace domefall {

struct WormholeZone {
  Wormhole wormhole;
  double l = 0;  // of the observer
  SkyRegion sky = SkyRegion::kI;
  HalfAngle edge{0, 1};  // of the edge's alpha
  double sign = 1;       // +1: the zone lies at larger alpha than its edge; -1: at smaller
  double reach = 0;      // radians from the edge to the far end, where the azimuth is 0
  double least = 1;      // radians; the smallest angle on which the azimuth has structure
  // Next to the edge bent_azimuth is -logarithm ln(distance) + c + O(distance ln(distance)).
  double logarithm = 1;

  // Returns the azimuth at a distance > 0 from the edge, in radians.  It falls from infinity to 0
  // at the reach, and goes on oddly beyond.
  double azimuth(double distance) const;
  // These are its two parts.  The first is that of the same wormhole without its cylinder, and the
  // second is closed and exact: cylinder_azimuth.
  double bent_azimuth(double distance) const;
  double straight_azimuth(double distance) const;

  // Returns the distance at which the azimuth is phi > 0, to a relative 1e-13.  Multiples of pi
  // are Einstein's rings: odd ones of the place of the sky opposite to R, which for the own sky is
  // behind the throat, and even ones of R itself.
  double distance_of(double phi) const;
  double einstein_ring(int half_turns) const;
};

// Returns the zone of the own side's sky, then that of the other side's.
std::array<WormholeZone, 2> wormhole_zones(const Wormhole& wormhole, double l);

}  // namespace domefall
