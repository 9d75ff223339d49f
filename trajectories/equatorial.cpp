#include "trajectories/equatorial.h"

#include <cmath>
#include <numbers>

namespace domefall {

using std::numbers::pi;

SkyDirection sky_direction(double ra_deg, double dec_deg) {
  const double ra = ra_deg * pi / 180, dec = dec_deg * pi / 180;
  return {V3d(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec))};
}

Equatorial equatorial(const SkyDirection& direction) {
  const V3d& d = direction.v;
  double ra_deg = std::atan2(d.y, d.x) * 180 / pi;
  if (ra_deg < 0) ra_deg += 360;
  return {ra_deg, std::atan2(d.z, std::hypot(d.x, d.y)) * 180 / pi};
}

}  // namespace domefall
