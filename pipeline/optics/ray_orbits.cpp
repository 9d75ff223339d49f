#include "pipeline/optics/ray_orbits.h"

#include <cmath>
#include <limits>

#include "pipeline/optics/ray_position.h"

namespace domefall {

void RayOrbits::set(const Radius& at, bool outgoing, const RayColumns& rays, int count) {
  count_ = count;
  ray_.clear();
  for (int k = 0; k < count; ++k) {
    const double sine = rays.sin_half[k], cosine = rays.cos_half[k];
    const auto gap = [&](const double* given, Critical edge) {
      return given ? given[k] : sine - tan_half_critical(at, edge) * cosine;
    };
    ray_.push_back({at, sine, cosine, gap(rays.gap_first, Critical::kFirst),
                    gap(rays.gap_second, Critical::kSecond), outgoing});
  }
}

void RayOrbits::find(const double* psi, RayPlaces& places) const {
  for (int k = 0; k < count_; ++k) {
    const NullRay& ray = ray_[static_cast<std::size_t>(k)];
    const auto r = exact_position(ray, psi[k]);
    const bool sky = origin_of(ray) != SkyRegion::kIV;
    places.r[k] = r.value_or(sky ? std::numeric_limits<double>::infinity() : 0);
    const RayInvariants i = invariants(ray);
    const double e = i.energy / i.angular_momentum, w = r ? 1 / *r : 0;
    const auto later = r ? exact_position(ray, psi[k] + 1e-7) : r;
    const double speed = std::sqrt(std::max(0.0, e * e - w * w * (1 - 2 * w)));
    places.slope[k] = !r ? 0 : (later ? *later > *r : sky) ? *r * *r * speed : -*r * *r * speed;
  }
}

}  // namespace domefall
