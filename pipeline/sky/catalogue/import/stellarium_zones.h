// The triangles by which Stellarium's catalogues order the sky: an icosahedron, each triangle cut into four
// again and again.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// Cut more than so often they have more stars than there are.
inline constexpr int kDeepestZones = 8;

// 20 times 4^level.
std::size_t zone_count(int level);

class StellariumZones {
 public:
  explicit StellariumZones(int level);

  struct Place {
    SkyDirection direction;
    double
        stretch;  // of a small motion there, square of the distance of the zone's plane: at least 1
  };
  // x0, x1: -1 to 1 along the zone's axes, east and north.
  Place place(std::size_t zone, double x0, double x1) const;

 private:
  struct Zone {
    V3d centre, east, north;
  };
  std::vector<Zone> zones_;
  double scale_ = 0;  // of x0, x1: the same for all, so that the largest zone fits
};

}  // namespace domefall
