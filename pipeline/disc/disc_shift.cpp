#include "pipeline/disc/disc_shift.h"

#include <algorithm>
#include <cmath>

#include "pipeline/disc/disc.h"

namespace domefall {
namespace {

double circular_shift(const DiscRay& ray, double r) {
  const double omega = 1 / (r * std::sqrt(r));
  return (ray.energy - omega * ray.about_axis) / std::sqrt(1 - 3 / r);
}

// Returns (E' E - u^r k^r)/(1 - 2/r) - L' L_n/r^2.  Where light and gas both move inwards, the two
// terms of the first numerator cancel next to the horizon, and the difference of their squares is
// divided by their sum instead.
double plunging_shift(const DiscRay& ray, double r, bool outward) {
  const double fall = kLastStableOrbit / r - 1, above = 1 - kHorizonRadius / r;
  const double energy = std::sqrt(8.0 / 9), momentum = 2 * std::sqrt(3.0);
  const double speed = fall * std::sqrt(fall) / 3;  // -u^r
  const double l = ray.angular_momentum / r, own = momentum / r;
  const double radial = std::sqrt(std::max(0.0, ray.energy * ray.energy - above * l * l));
  const double turned = own * ray.about_axis / r;
  if (outward) return (energy * ray.energy + speed * radial) / above - turned;
  const double squares = ray.energy * ray.energy * (1 + own * own) + energy * energy * l * l -
                         above * (1 + own * own) * l * l;
  return squares / (energy * ray.energy + speed * radial) - turned;
}

}  // namespace

DiscRay disc_ray(const RayInvariants& ray, const V3d& place, const V3d& tangent,
                 const V3d& normal) {
  return {ray.energy, ray.angular_momentum,
          -ray.angular_momentum * place.cross(tangent).dot(normal)};
}

double disc_shift(const DiscRay& ray, double r, bool outward) {
  return r < kLastStableOrbit ? plunging_shift(ray, r, outward) : circular_shift(ray, r);
}

}  // namespace domefall
