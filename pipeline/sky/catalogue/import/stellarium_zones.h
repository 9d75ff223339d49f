// Stellarium's catalogues order the sky by these triangles: those of an icosahedron, each cut into
// four again and again.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// No deeper level is read.  This one has 1.3 million zones, so a greater number in a file is a
// mistake.
inline constexpr int kDeepestZones = 8;

// Returns the number of triangles of a level, which is 20 times 4^level.
std::size_t zone_count(int level);

class StellariumZones {
 public:
  // Makes the zones of a level from 0 to kDeepestZones.
  explicit StellariumZones(int level);

  struct Place {
    SkyDirection direction;
    // A small motion away from the zone's centre is longer in the zone's plane than on the unit
    // sphere by this factor (at least 1).  The plane touches the sphere at the zone's centre, and
    // the place there is tan(angle) away from that centre.  The factor is the derivative of tan,
    // 1/cos^2(angle), which is the square of the place's distance from the centre of the sphere.
    double stretch;
  };
  // Returns a place by its coordinates x0 and x1.  They go from -1 to 1, along the zone's axes to
  // the east and north.
  Place place(std::size_t zone, double x0, double x1) const;

 private:
  struct Zone {
    V3d centre, east, north;
  };
  std::vector<Zone> zones_;
  double scale_ = 0;  // length of one unit of x0 and x1, with which the largest zone just fits
};

}  // namespace domefall
