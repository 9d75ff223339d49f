#include "pipeline/render/pixel_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/render/disc_scene.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/scene/seen_magnitude.h"
#include "pipeline/render/scene/star_light.h"
#include "pipeline/render/scene/star_sight.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr double kInDegrees = 180 / std::numbers::pi;

std::vector<std::string> names_of_star(const StarCatalogue& catalogue, const Star& star) {
  std::vector<std::string> names;
  for (const NamedStar& name : catalogue.names)
    if (name.direction.v == star.direction.v) names.push_back(name.name);
  return names;
}

}  // namespace

PixelProbe::PixelProbe(const Show& show, const FrameState& state, PixelPosition pixel)
    : show_(show),
      pixel_(pixel),
      towards_(direction_at(state.projection, pixel)),
      width_(pixel_angle(state.projection, pixel)),
      scene_(std::make_unique<const DiscScene>(show, state)),
      state_(scene_->scene.state),
      sight_(state_, show.effects, show.least_star_radius),
      bodies_(bodies_at(show, state_.settings)),
      covers_(sight_, bodies_, scene_->scene.point_spread.least()) {}

PixelProbe::~PixelProbe() = default;

ViewRay PixelProbe::ray() const { return scene_->scene.tracer.trace(towards_); }

double PixelProbe::left_of_sky() const { return scene_->left_before(towards_, HUGE_VAL, width_); }

double PixelProbe::left_by_bodies() const { return covers_.left_before(towards_, HUGE_VAL); }

// What is seen at the pixel of an image is hidden there.
double PixelProbe::left_before(const CameraDirection& image, double way, double far) const {
  return scene_->left_before(image, way, width_) * covers_.left_before(towards_, far);
}

bool PixelProbe::reaches(const CameraDirection& image) const {
  constexpr double kSigmas = 3.5;  // how far the smallest blob reaches
  return (image.v - towards_.v).length() <= kSigmas * scene_->scene.point_spread.least();
}

std::vector<DiscAtPixel> PixelProbe::disc() const {
  std::vector<DiscAtPixel> found;
  if (!scene_->disc) return found;
  for (const DiscPass::Place& place : scene_->disc->places(towards_, width_))
    found.push_back({place.order, place.r, place.azimuth * kInDegrees, place.frequency_ratio,
                     scene_->light->temperature(place.r), place.covered});
  return found;
}

std::vector<StarAtPixel> PixelProbe::stars() const {
  const StarSight sight(state_, show_.effects);
  std::vector<StarAtPixel> found;
  for (const SkyRegion sky : kExteriorSkies) {
    const auto& field = show_.sky[sky].stars;
    if (!field || !sight.sees(sky)) continue;
    const FrameSettings::Sky& settings = state_.settings.sky[sky];
    const double gain = settings.star_gain / default_star_gain(show_.point_spread);
    const StarCatalogue catalogue =
        read_star_field(*field, settings.max_magnitude, show_.star_epoch);
    for (const Star& star : catalogue.stars) {
      const double v = star.v_magnitude, drawn = gain * part_within_limit(settings, v);
      if (!(drawn > 0)) break;  // those that follow are fainter
      int faint = 0;            // images in succession
      for (int order = 0; order < sight.orders(); ++order) {
        const StarSight::Image image = sight.image(sky, star.direction, order);
        const auto seen_v = [&](double left) {
          return seen_magnitude(show_.effects, v, star.temperature,
                                left * drawn * image.brightening, image.frequency_ratio);
        };
        // The images of a pair of orders lie on opposite sides of the hole, where motion may dim
        // one of them alone.  If both are too faint, so are all that follow.
        faint = seen_v(1) <= kFaintestSeen ? 0 : faint + 1;
        if (faint == 2) break;
        if (faint > 0 || !reaches(image.direction)) continue;
        const auto at = pixel_of(state_.projection, image.direction);
        const double seen = seen_v(left_before(image.direction, HUGE_VAL, HUGE_VAL));
        if (!at || !(seen <= kFaintestSeen)) continue;
        const Equatorial place = equatorial(star.direction);
        found.push_back({names_of_star(catalogue, star), sky, place.ra_deg, place.dec_deg, v,
                         star.temperature, seen, order, *at});
      }
    }
  }
  std::ranges::stable_sort(found, {}, &StarAtPixel::seen_v);
  return found;
}

std::vector<BodyAtPixel> PixelProbe::bodies() const {
  const double sigma = scene_->scene.point_spread.least();
  std::vector<BodyAtPixel> found;
  if (!sight_.sees()) return found;
  for (const Body& body : bodies_) {
    int faint = 0;
    for (int order = sight_.first_order(body);
         order < BodySight::kMostOrders && faint < BodySight::kFaintOrders; ++order) {
      const auto image = sight_.image(body, order);
      if (!image) break;
      const BodySight::Seen seen = sight_.seen(image->at);
      const double left =
          left_before(seen.direction, image->traced.way(), sight_.far(body, image->traced));
      const auto pieces = sight_.pieces(body, *image, sigma);
      const double magnitude = sight_.seen_v(body, image->at, pieces) - 2.5 * std::log10(left);
      faint = magnitude <= kFaintestSeen ? 0 : faint + 1;
      const auto at = pixel_of(state_.projection, seen.direction);
      if (faint > 0 || !at) continue;
      const auto is_near = [&](const BodySight::Piece& piece) {
        return reaches(sight_.seen(piece.at).direction);
      };
      if (is_near({image->at}) || std::ranges::any_of(pieces, is_near))
        found.push_back({body.name, image->traced.r, magnitude, seen.frequency_ratio, order, *at});
    }
  }
  std::ranges::stable_sort(found, {}, &BodyAtPixel::seen_v);
  return found;
}

std::vector<std::string> PixelProbe::titles() const {
  std::vector<std::string> found;
  if (!is_in_image(state_.projection, pixel_)) return found;
  const int width = columns(state_.projection),
            column = static_cast<int>(std::lround(pixel_.i)) - 1,
            row = static_cast<int>(std::lround(pixel_.j)) - 1;
  for (const SeenTitle& seen : seen_titles(show_, state_)) {
    const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column);
    if (!seen.text.empty() && covered_by(show_, seen, state_)[pixel] > 0)
      found.push_back(seen.text);
  }
  return found;
}

}  // namespace domefall
