#include "pipeline/render/scene/scene_stars.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/render/scene/seen_magnitude.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

// Returns the angular radius rho of a star.  A disc of radiance B brings the flux B pi rho^2.
double angular_radius(double flux, double temperature) {
  return std::sqrt(flux / (blackbody_radiance(temperature) * std::numbers::pi));
}

}  // namespace

SceneStars::SceneStars(const std::vector<Star>& stars) {
  std::vector<std::uint32_t> order(stars.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto brighter = [&](std::uint32_t a, std::uint32_t b) {
    return stars[a].v_magnitude < stars[b].v_magnitude;
  };
  // Catalogues are sorted as a rule, so that the test saves time.
  if (!std::ranges::is_sorted(order, brighter)) std::ranges::stable_sort(order, brighter);
  reserve(stars.size());
  for (const std::uint32_t k : order) {
    const Star& s = stars[k];
    const double flux = std::pow(10, -0.4 * s.v_magnitude) * flux_of_v_zero(s.temperature);
    push_back(s.direction.v, s.v_magnitude, flux, s.temperature);
  }
  find_bounds();
}

SceneStars::SceneStars(std::vector<SceneStar> stars) {
  std::ranges::stable_sort(stars, {}, &SceneStar::magnitude);
  reserve(stars.size());
  for (const SceneStar& s : stars) {
    push_back(s.direction.v, s.magnitude, s.flux, s.temperature);
    // The star's own radius takes the place of the one that follows from its flux.
    angular_radius_.back() = static_cast<float>(s.angular_radius);
  }
  find_bounds();
}

void SceneStars::reserve(std::size_t count) {
  for (auto* column : {&x_, &y_, &z_, &magnitude_, &flux_, &temperature_, &angular_radius_})
    column->reserve(count);
}

void SceneStars::push_back(const V3d& d, double magnitude, double flux, double temperature) {
  x_.push_back(static_cast<float>(d.x));
  y_.push_back(static_cast<float>(d.y));
  z_.push_back(static_cast<float>(d.z));
  magnitude_.push_back(static_cast<float>(magnitude));
  flux_.push_back(static_cast<float>(flux));
  temperature_.push_back(static_cast<float>(temperature));
  angular_radius_.push_back(static_cast<float>(angular_radius(flux, temperature)));
}

void SceneStars::find_bounds() {
  for (const float radius : angular_radius_)
    most_angular_radius_ = std::max(most_angular_radius_, double{radius});
  most_flux_.assign(size() / kBlock + 1, 0);
  for (std::size_t k = 0; k < size(); ++k)
    most_flux_[k / kBlock] = std::max(most_flux_[k / kBlock], double{flux_[k]});
  // A block's bound holds for the blocks after it too.
  for (std::size_t b = most_flux_.size() - 1; b-- > 0;)
    most_flux_[b] = std::max(most_flux_[b], most_flux_[b + 1]);
}

SceneStar SceneStars::operator[](std::size_t k) const {
  return {{renormalized(V3d(x_[k], y_[k], z_[k]))},
          magnitude_[k],
          flux_[k],
          temperature_[k],
          angular_radius_[k]};
}

// Magnitudes are floats.  The limit is rounded as they were, so that no star on the limit is lost.
std::size_t SceneStars::count_to_magnitude(double limit) const {
  const auto end = std::partition_point(magnitude_.begin(), magnitude_.end(), [limit](float v) {
    return v <= static_cast<float>(limit);
  });
  return static_cast<std::size_t>(end - magnitude_.begin());
}

}  // namespace domefall
