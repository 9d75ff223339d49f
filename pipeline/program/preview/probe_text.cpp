#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pipeline/program/preview/live_pictures.h"
#include "pipeline/render/pixel_probe.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

void add_ray(const ViewRay& ray, double width, Json& json) {
  json["sky"] = name_of(ray.sky);
  if (!ray.known) return;
  const Equatorial at = equatorial({ray.sky_direction});
  json["ra_deg"] = at.ra_deg;
  json["dec_deg"] = at.dec_deg;
  if (ray.sky == SkyRegion::kIV) return;  // the past singularity's light has no redshift
  json["redshift"] = 1 / ray.frequency_ratio;
  json["amplification"] = amplification(ray.bundle, width);
  json["order"] = static_cast<int>(ray.swept / std::numbers::pi);
}

Json star_near(const std::vector<NamedImage>& images, const Projection& projection,
               PixelPosition at) {
  constexpr double kNear = 8;  // pixels
  const NamedImage* nearest = nullptr;
  double least = kNear;
  const auto bare = [](const NamedImage& image) {
    constexpr std::string_view kPrime = "\u2032";
    return image.name.substr(0, image.name.size() - (image.secondary ? kPrime.size() : 0));
  };
  for (const NamedImage& image : images) {
    const auto pixel = pixel_of(projection, image.direction);
    if (!pixel || !is_inside(projection, *pixel)) continue;
    const double distance = std::hypot(pixel->i - at.i, pixel->j - at.j);
    if (distance < least) least = distance, nearest = &image;
  }
  if (!nearest) return {};
  Json star = {{"name", bare(*nearest)}, {"magnitude", nearest->magnitude}};
  star["images"] = Json::array();
  for (const NamedImage& image : images) {
    if (bare(image) != bare(*nearest)) continue;
    if (const auto pixel = pixel_of(projection, image.direction))
      star["images"].push_back({pixel->i, pixel->j});
  }
  return star;
}

}  // namespace

std::string LivePictures::probe(const PictureRequest& request, PixelPosition at) {
  const FrameState state = state_for(request);
  prepare(request);
  const FrameState& seen = dominant_view(state);
  Json json = {{"inside", is_inside(seen.projection, at)},
               {"region", is_flat(seen.observer)
                              ? Json()
                              : Json(region_name(seen.observer.region, seen.observer.universe))},
               {"r", seen.observer.r}};
  const PixelProbe pixel(prepared_, seen, at);
  add_ray(pixel.ray(), pixel_angle(seen.projection, at), json);
  for (const DiscAtPixel& disc : pixel.disc())
    json["disc"].push_back({{"r", disc.r},
                            {"azimuth_deg", disc.azimuth_deg},
                            {"redshift", 1 / disc.frequency_ratio},
                            {"temperature_k", disc.temperature},
                            {"order", disc.order}});
  json["left"] = pixel.left_of_sky() * pixel.left_by_bodies();
  for (const BodyAtPixel& body : pixel.bodies()) json["bodies"].push_back(body.name);
  for (const std::string& title : pixel.titles()) json["titles"].push_back(title);
  json["star"] = star_near(labels_->images(seen), seen.projection, at);
  // A catalogue's names need not be UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace domefall
