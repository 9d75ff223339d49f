#include "pipeline/render/scene/body_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/sphere_image.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/star_light.h"

namespace domefall {
namespace {

// Says whether the observer is outside a body of that radius, which then has an angular radius
// below 1 radian.  The size within the ray's plane decides, since the lens stretches an image
// behind the hole about the axis only.
bool is_outside(const BodyImage& image, double radius) {
  return image.angle_per_length * radius < 1;
}

}  // namespace

BodySight::BodySight(const FrameState& state, const Effects& effects, double least_radius)
    : effects_(effects),
      observer_(state.observer),
      viewer_(viewer_of(state.observer, effects)),
      lens_(lens_of(observer_, WantedSkies{{false, false, false}}, effects)),
      least_radius_(least_radius) {}

bool BodySight::sees() const { return effects_.lensing && sees_bodies(observer_); }

SceneStar BodySight::star_of(const Body& body) {
  const Star star{body.normal, static_cast<float>(body.magnitude),
                  static_cast<float>(body.temperature)};
  return SceneStars({star})[0];
}

double BodySight::radius_of(const Body& body) const {
  if (body.radius > 0) return body.radius;
  return std::max(star_of(body).angular_radius, least_radius_) * kBodyMagnitudeDistance;
}

std::optional<BodyImage> BodySight::traced(const Body& body, int order,
                                           const std::optional<double>& emitted) const {
  BodyMotion motion = motion_of(observer_.spacetime, body, observer_.sky_from_tetrad);
  motion.guess = emitted;
  return lens_->body_image(observer_.null_time, motion, order, radius_of(body));
}

int BodySight::first_order(const Body& body) const {
  if (!is_too_near(body)) return 0;
  return body.radius > 0 ? kMostOrders : 1;
}

bool BodySight::is_too_near(const Body& body) const {
  const auto direct = traced(body, 0);
  return direct && !is_outside(*direct, radius_of(body));
}

std::optional<BodySight::Image> BodySight::image(const Body& body, int order,
                                                 const std::optional<double>& emitted) const {
  const auto image = traced(body, order, emitted);
  if (!image || !is_outside(*image, radius_of(body))) return std::nullopt;
  // At kBodyMagnitudeDistance an area has the solid angle 1/distance^2 of itself.
  const double light =
      image->solid_angle_per_area * kBodyMagnitudeDistance * kBodyMagnitudeDistance;
  return Image{{{image->direction}, image->frequency_ratio, light}, *image};
}

std::vector<SkyImage> BodySight::pieces(const Body& body, const Image& image, double sigma) const {
  // By Poisson's sum formula a row of Gaussians, d sigma apart, ripples by 2 exp(-2 pi^2/d^2) of
  // its mean, which is 3e-4 here.
  constexpr double kSpacing = 1.5;
  const double radius = radius_of(body), whole = radius / kBodyMagnitudeDistance;
  const auto spacing = [&](const V3d& direction) {
    return kSpacing * sigma * to_observer(viewer_.celerity, direction).frequency_ratio;
  };
  if (effects_.amplification == Amplification::kNone ||
      size_of_sphere(image.traced, radius) <= spacing(image.at.direction.v))
    return {};
  std::vector<SkyImage> pieces = image_of_sphere(image.traced, radius, spacing);
  // The pieces have their solid angles, which become amplifications of the whole disc of the star.
  for (SkyImage& piece : pieces) piece.amplification /= std::numbers::pi * whole * whole;
  return pieces;
}

BodySight::Seen BodySight::seen(const SkyImage& image) const {
  const AberratedLight at = to_observer(viewer_.celerity, image.direction.v);
  double g = image.frequency_ratio * at.frequency_ratio;
  if (viewer_.measured) g *= to_observer(*viewer_.measured, at.direction).frequency_ratio;
  return {{apply_transposed(observer_.tetrad_from_camera, at.direction)},
          received_flux(effects_, 1, image.amplification, at.frequency_ratio, g),
          g};
}

// A boost divides solid angles by doppler^2, which the amplification in the other tetrad undoes.
SkyImage BodySight::moved_to(const BodySight& other, const SkyImage& image) const {
  const AberratedLight at = to_observer(viewer_.celerity, image.direction.v);
  const V3d in_camera = apply_transposed(observer_.tetrad_from_camera, at.direction);
  const AberratedLight there =
      to_tetrad(other.viewer_.celerity, apply(other.observer_.tetrad_from_camera, in_camera));
  const double ratio = at.frequency_ratio * there.frequency_ratio;
  return {{there.direction}, image.frequency_ratio * ratio, image.amplification / (ratio * ratio)};
}

bool is_bright(double magnitude, double brightening, const FrameSettings& settings) {
  constexpr double kFaintest = 10;                           // V at 0 EV
  const double magnitudes_per_stop = 2.5 * std::log10(2.0);  // a stop doubles the light
  // A factor in flux is 2.5 log10 of it in magnitudes.
  return magnitude - 2.5 * std::log10(brightening) < kFaintest + magnitudes_per_stop * settings.ev;
}

}  // namespace domefall
