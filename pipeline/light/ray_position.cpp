#include "pipeline/light/ray_position.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/orbit_cubic.h"
#include "pipeline/light/ray_point.h"

namespace domefall {
namespace {

// Below this L/(r |E|) an orbit is straight wherever r is a number of use.
constexpr double kNearlyRadial = 1e-40;

// Returns r at an angle from an end of the orbit.
double radius_from(const Cubic& c, bool sky, double angle) {
  const double e = std::sqrt(c.inverse_b2);
  const RayPoint s = point_from_singularity(e, c.eps, angle);
  return sky ? point_from_sky(e, s).r : 1 / s.w;
}

std::optional<double> nearly_radial_position(const NullRay& ray, const RayInvariants& k,
                                             double psi) {
  if (psi >= exact_azimuth(ray)) return std::nullopt;
  return 1 / (1 / ray.at.r + k.radial / k.angular_momentum * psi);
}

}  // namespace

std::optional<double> exact_position(const NullRay& ray, double psi) {
  if (psi == 0) return ray.at.r;
  const RayInvariants k = invariants(ray);
  if (k.angular_momentum == 0) return std::nullopt;
  if (k.angular_momentum < kNearlyRadial * ray.at.r * (std::abs(k.energy) + std::abs(k.radial)))
    return nearly_radial_position(ray, k, psi);
  const Cubic c = cubic_of(ray.at, k);
  if (c.eps == 0 && c.x == 0) return ray.at.r;  // on the light circle itself
  const double left = exact_azimuth(ray) - psi;
  if (!(left > 0)) return std::nullopt;
  const EndAzimuths ends = end_azimuths(c);
  const bool inwards = k.radial > 0;  // back in time
  if (c.eps < 0) {
    const bool from_sky = c.x < 0;
    const double passed = (from_sky ? ends.sky : ends.singularity) + psi;
    // A path that turns is the same on both sides of the turning point.
    return radius_from(c, from_sky, inwards == from_sky ? std::min(passed, left) : left);
  }
  const double rho = inwards ? ends.sky + psi : left;
  const double sigma = inwards ? left : ends.singularity + psi;
  return radius_from(c, rho < sigma, std::min(rho, sigma));
}

}  // namespace domefall
