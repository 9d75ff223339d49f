#include "pipeline/show/placement.h"

#include <cmath>

namespace domefall {

M33d place_tetrad(const SkyDirection& hole_at, double heading, double azimuth) {
  const V3d r0 = -hole_at.v;
  const bool at_pole = std::hypot(r0.x, r0.y) < 1e-12;
  const V3d east = at_pole ? V3d(0, 1, 0) : V3d(-r0.y, r0.x, 0).normalized();
  const V3d north = r0.cross(east);
  const V3d t = north * std::cos(heading) + east * std::sin(heading);
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  return from_columns(r0 * c + t * s, -r0.cross(t), t * c - r0 * s);
}

}  // namespace domefall
