#include "pipeline/render/scene.h"

#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/read_image.h"
#include "pipeline/sky/star_catalogue.h"

namespace domefall {
namespace {

std::vector<SceneStar> scene_stars(const StarCatalogue& catalogue, double gain) {
  std::vector<SceneStar> stars;
  stars.reserve(catalogue.stars.size());
  for (const Star& s : catalogue.stars) {
    const double t = s.temperature;
    const double flux = gain * std::pow(10, -0.4 * s.v_magnitude) * bolometric_flux_at_v_zero(t);
    // flux = surface radiance * pi rho^2
    const double radius = std::sqrt(flux / (blackbody_radiance(t) * std::numbers::pi));
    stars.push_back({s.direction, flux, t, radius});
  }
  return stars;
}

FloatImage read_panorama(const std::filesystem::path& file) {
  FloatImage image = read_image(file);
  if (image.width < 4 || image.height < 2 || image.width != 2 * image.height)
    throw InputError(
        file.string() + ": a panorama is twice as wide as high, at least 4 x 2 pixels; " +
        "this one is " + std::to_string(image.width) + " x " + std::to_string(image.height));
  return image;
}

bool same_background(const RegionSky& a, const RegionSky& b) {
  const auto *p = std::get_if<PanoramaSky>(&a.background),
             *q = std::get_if<PanoramaSky>(&b.background);
  return p && q && p->image == q->image;
}

bool same_stars(const RegionSky& a, const RegionSky& b) {
  return a.stars && b.stars && a.star_gain == b.star_gain &&
         a.stars->catalogue == b.stars->catalogue &&
         a.stars->max_magnitude == b.stars->max_magnitude;
}

}  // namespace

Sky Scene::load(const RegionSky& region) {
  Sky sky;
  sky.background_gain = static_cast<float>(region.background_gain);
  if (std::holds_alternative<GridSky>(region.background)) sky.background = Grid{};
  if (const auto* panorama = std::get_if<PanoramaSky>(&region.background))
    sky.background = std::make_shared<const SkyMap>(read_panorama(panorama->image));
  std::vector<SceneStar> stars;
  if (region.stars && region.star_gain > 0)
    stars = scene_stars(read_star_catalogue(region.stars->catalogue, region.stars->max_magnitude),
                        region.star_gain);
  sky.stars = std::make_shared<const std::vector<SceneStar>>(std::move(stars));
  return sky;
}

const Sky& Scene::sky_one() {
  const std::scoped_lock lock(loading_);
  if (!one_) one_ = std::make_unique<Sky>(load(show_.sky_one));
  return *one_;
}

const Sky& Scene::sky_three() {
  const Sky& one = sky_one();
  const std::scoped_lock lock(loading_);
  if (three_) return *three_;
  RegionSky rest = show_.sky_three;
  const bool shared_background = same_background(show_.sky_one, rest),
             shared_stars = same_stars(show_.sky_one, rest);
  if (shared_background) rest.background = BlackSky{};
  if (shared_stars) rest.stars.reset();
  three_ = std::make_unique<Sky>(load(rest));
  if (shared_background) three_->background = one.background;
  if (shared_stars) three_->stars = one.stars;
  return *three_;
}

}  // namespace domefall
