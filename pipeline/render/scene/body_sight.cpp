#include "pipeline/render/scene/body_sight.h"

#include <algorithm>
#include <cmath>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/emission_time.h"
#include "pipeline/render/scene/star_light.h"

namespace domefall {
namespace {

// A body on a circular orbit, in the directions of the observer's tetrad.  Its azimuth counts from
// where v = 0.
BodyMotion motion_of(const Body& body, const M33d& sky_from_tetrad) {
  const V3d normal = apply_transposed(sky_from_tetrad, body.normal.v);
  const V3d node = apply_transposed(sky_from_tetrad, body.node.v);
  const V3d onward = normal.cross(node);
  const double r = body.r, rate = 1 / (r * std::sqrt(r)), u_t = 1 / std::sqrt(1 - 3 / r);
  const V3d momentum = normal * (r * r * rate * u_t);
  const double star = tortoise(r), azimuth = body.azimuth;
  return [=](double t) {
    const double phi = azimuth + rate * (t + star);
    return BodyPoint{node * std::cos(phi) + onward * std::sin(phi), r, (1 - 2 / r) * u_t, 0,
                     momentum};
  };
}

}  // namespace

BodySight::BodySight(const Show& show, const FrameState& state)
    : show_(show), observer_(state.observer), vantage_(vantage_of(state.observer, show.effects)) {}

// Nothing comes from region I to region IV.  The mirrored frames are those of region III.
bool BodySight::sees() const {
  return !show_.bodies.empty() && !is_flat(observer_) && show_.effects.lensing &&
         !is_mirrored(observer_.tetrad) && observer_.region != Region::kIV;
}

SceneStar BodySight::star_of(const Body& body) {
  const Star star{body.normal, static_cast<float>(body.magnitude),
                  static_cast<float>(body.temperature)};
  return SceneStars({star})[0];
}

std::optional<BodySight::Image> BodySight::image(const Body& body, int order) const {
  const double radius =
      std::max(star_of(body).angular_radius, show_.least_star_radius) * kBodyMagnitudeDistance;
  const PlaceView view{observer_.r, is_outgoing(observer_.tetrad), false};
  const auto image = image_of_body(view, observer_.null_time,
                                   motion_of(body, observer_.sky_from_tetrad), order, radius);
  if (!image) return std::nullopt;
  const double light =
      image->solid_angle_per_area * kBodyMagnitudeDistance * kBodyMagnitudeDistance;
  return Image{{{image->direction}, image->frequency_ratio, light}, image->r, image->psi};
}

BodySight::Seen BodySight::seen(const SkyImage& image) const {
  const AberratedLight at = to_observer(vantage_.celerity, image.direction.v);
  double g = image.frequency_ratio * at.frequency_ratio;
  if (vantage_.measured) g *= to_observer(*vantage_.measured, at.direction).frequency_ratio;
  return {{apply_transposed(observer_.tetrad_from_camera, at.direction)},
          received_flux(show_.effects, 1, image.amplification, at.frequency_ratio, g),
          g};
}

}  // namespace domefall
