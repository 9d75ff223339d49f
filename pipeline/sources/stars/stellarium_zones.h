// What the records of Stellarium's catalogues mean.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pipeline/sources/stars/raw_catalogue.h"
#include "trajectories/directions.h"

namespace domefall {

// No deeper level is read.  This one has 1.3 million zones, so a greater number in a file is a
// mistake.
inline constexpr int kDeepestZones = 8;

// Returns the number of triangles of a level, which is 20 times 4^level.
std::size_t zone_count(int level);

// Up to version 24 the catalogues order the sky by these triangles: those of an icosahedron, each cut
// into four again and again.
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

// From version 25 of Stellarium on, its catalogues are made of Hipparcos and Gaia's third release.
// Each record begins with the star's number in the latter, of 64 bits, and all numbers are little
// endian.  The layout is that of Stellarium's src/core/modules/Star.hpp.

// The sizes of the records by their types, 0 to 2.
inline constexpr std::array<std::size_t, 3> kStellariumGaiaSizes{48, 32, 16};

// Returns the star of a record of a type, at J2016.0, whatever its bytes are.  It may be none: its
// direction need not be a unit vector, and its magnitude and motion may be beyond all limits.
CatalogueStar stellarium_gaia_star(int type, const char* bytes);

}  // namespace domefall
