#include "pipeline/sky/catalogue/proper_motion.h"

#include <cmath>
#include <numbers>

namespace domefall {

// With rho = cos Dec, the unit vectors at p are east = (-sin RA, cos RA, 0) and north = (-sin Dec
// cos RA, -sin Dec sin RA, cos Dec).  In the code c = cos RA, s = sin RA and p.z = sin Dec.
SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years) {
  constexpr double kRadiansPerMas = std::numbers::pi / 180 / 3.6e6;
  const V3d& p = from.v;
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const double c = rho > 0 ? p.x / rho : 1, s = rho > 0 ? p.y / rho : 0;
  const double east = pm_ra * years * kRadiansPerMas, north = pm_dec * years * kRadiansPerMas;
  const V3d q(p.x - east * s - north * p.z * c, p.y + east * c - north * p.z * s,
              p.z + north * rho);
  return {q / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)};
}

}  // namespace domefall
