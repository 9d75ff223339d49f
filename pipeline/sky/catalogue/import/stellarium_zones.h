// The triangles by which Stellarium's catalogues order the sky: those of an icosahedron, each cut
// into four again and again.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// No deeper level is read; this one has 1.3 million zones.  A greater number in a file is a
// mistake.
inline constexpr int kDeepestZones = 8;

// A level has 20 times 4^level triangles.
std::size_t zone_count(int level);

class StellariumZones {
 public:
  // Makes the zones of a level from 0 to kDeepestZones.
  explicit StellariumZones(int level);

  struct Place {
    SkyDirection direction;
    // This is the factor (at least 1) by which a small motion there is longer in the zone's plane
    // than on the unit sphere: the square of the distance from the centre.
    double stretch;
  };
  // Returns a place by its coordinates x0 and x1, from -1 to 1, along the zone's axes to the east
  // and north.
  Place place(std::size_t zone, double x0, double x1) const;

 private:
  struct Zone {
    V3d centre, east, north;
  };
  std::vector<Zone> zones_;
  double scale_ = 0;  // length of one unit of x0 and x1, by which the largest zone just fits
};

}  // namespace domefall
