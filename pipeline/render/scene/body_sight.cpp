#include "pipeline/render/scene/body_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/kerr_body_image.h"
#include "pipeline/light/sphere_surface.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/body_surface.h"
#include "pipeline/render/scene/point_spread.h"
#include "pipeline/render/scene/seen_magnitude.h"
#include "pipeline/render/scene/star_light.h"

namespace domefall {
namespace {

// Says whether the observer is outside a body of that radius to first order, where it has an angular
// radius below 1 radian.  The size within the ray's plane decides, since the lens stretches an image
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
  if (lens_->lists_bodies()) {
    const std::vector<BodyImage>& images = listed(body);
    const auto k = static_cast<std::size_t>(order);
    return k < images.size() ? std::optional(images[k]) : std::nullopt;
  }
  BodyMotion motion = motion_of(observer_.spacetime, body, observer_.sky_from_tetrad);
  motion.guess = emitted;
  return lens_->body_image(observer_.null_time, motion, order, radius_of(body));
}

const std::vector<BodyImage>& BodySight::listed(const Body& body) const {
  const std::scoped_lock lock(mutex_);
  const auto known = listed_.find(body.name);
  if (known != listed_.end()) return known->second;
  const BodyMotion motion = motion_of(observer_.spacetime, body, observer_.sky_from_tetrad);
  return listed_
      .emplace(body.name, lens_->body_images(observer_.null_time, motion, radius_of(body)))
      .first->second;
}

double BodySight::size_of(const BodyImage& image, double radius) const {
  return lens_->lists_bodies() ? kerr_size_of_sphere(image, radius) : size_of_sphere(image, radius);
}

double BodySight::reach(const Body& body, const Image& image) const {
  constexpr double kMost = std::numbers::pi / 8;  // of arcs next to a caustic
  if (!(body.radius > 0)) return 0;
  const double radius = body.radius * (body.rings.empty() ? 1 : body.rings.back().outer);
  return std::min(size_of(image.traced, radius) / 2 / seen(image.at).doppler, kMost);
}

int BodySight::first_order(const Body& body) const {
  if (!is_too_near(body)) return 0;
  return body.radius > 0 ? kMostOrders : 1;
}

bool BodySight::is_too_near(const Body& body) const {
  const auto direct = traced(body, 0);
  if (!direct) return false;
  if (!is_traced()) return !is_outside(*direct, radius_of(body));
  const Spacetime& spacetime = observer_.spacetime;
  return is_within_sphere(spacetime, observer_.r, observer_v(),
                          motion_of(spacetime, body, observer_.sky_from_tetrad),
                          direct->proper_time, radius_of(body));
}

double BodySight::observer_v() const {
  const bool outgoing = is_outgoing(observer_.tetrad);
  return observer_.null_time + (outgoing ? 2 * observer_.spacetime.tortoise(observer_.r) : 0);
}

// All light goes forward in the time v - r of Kerr and Schild, and in a wormhole in v - l = t.  In flat
// space it is t, and light that goes in a time d to the centre of a sphere goes in sqrt(d^2 - a^2) to its
// rim.  A ray that meets the sphere does so before and after that.
double BodySight::far(const Body& body, const BodyImage& image) const {
  const BodyPoint left =
      motion_of(observer_.spacetime, body, observer_.sky_from_tetrad).at(image.proper_time);
  const bool hole = !observer_.spacetime.is<Wormhole>();
  const double ago = observer_v() - (hole ? observer_.r : observer_.l) -
                     (left.null_time - (hole ? left.r : left.l));
  return ago * ago - body.radius * body.radius;
}

bool BodySight::is_traced() const {
  return !observer_.spacetime.is<Wormhole>() && !lens_->lists_bodies();
}

std::optional<BodySight::Image> BodySight::image(const Body& body, int order,
                                                 const std::optional<double>& emitted) const {
  const auto image = traced(body, order, emitted);
  if (!image || !(is_traced() || is_outside(*image, radius_of(body)))) return std::nullopt;
  // At kBodyMagnitudeDistance an area has the solid angle 1/distance^2 of itself.
  const double light =
      image->solid_angle_per_area * kBodyMagnitudeDistance * kBodyMagnitudeDistance;
  return Image{{{image->direction}, image->frequency_ratio, light}, *image};
}

std::vector<BodySight::Piece> BodySight::pieces(const Body& body, const Image& image, double sigma,
                                                bool in_trail) const {
  const double pixel = sigma / kLeastSigmaPixels;  // at most
  // By Poisson's sum formula a row of Gaussians, d sigma apart, ripples by 2 exp(-2 pi^2/d^2) of
  // its mean, which is 3e-4 here.
  constexpr double kSpacing = 1.5;
  const double radius = radius_of(body), whole = radius / kBodyMagnitudeDistance,
               size = size_of(image.traced, radius);
  const BodySurface surface(body, image.traced, observer_);
  // A small sphere with a surface has a phase all the same.
  constexpr double kLeastPieces = 16;
  const double most = surface.is_even() ? HUGE_VAL : size / kLeastPieces;
  const auto spacing = [&](const V3d& direction) {
    return std::min(most,
                    kSpacing * sigma * to_observer(viewer_.celerity, direction).frequency_ratio);
  };
  if (effects_.amplification == Amplification::kNone || size <= spacing(image.at.direction.v))
    return {};
  std::vector<Piece> pieces;
  // The pieces have their solid angles, which become amplifications of the whole disc of the star.
  const auto add = [&](const SkyImage& at, const WorkingRgb& tint, double light, double covered) {
    // A dark side has pieces, too, which hide what is behind them.
    pieces.push_back({at, tint, covered * at.amplification});
    pieces.back().at.amplification *= light / (std::numbers::pi * whole * whole);
  };
  const RingedSphere seen =
      sphere(body, image.traced, surface, (in_trail ? 1 : 0.1) * pixel, spacing);
  for (const SpherePiece& piece : seen.sphere) {
    const double left = surface.left_by(piece.through);
    add(piece.at, surface.tint(piece), left * surface.light(piece), left);
  }
  for (const RingPiece& piece : seen.rings)
    add(piece.at, body.rings[static_cast<std::size_t>(piece.ring)].colour, surface.light(piece),
        1 - surface.left_by(piece));
  return pieces;
}

// To first order, angles err by a part of about the size over the distance from the observer or from
// the hole.
RingedSphere BodySight::sphere(const Body& body, const BodyImage& image, const BodySurface& surface,
                               double error,
                               const std::function<double(const V3d&)>& spacing) const {
  const double radius = radius_of(body), half = image.angle_per_length * radius;
  if (lens_->lists_bodies()) {
    // Small ones before are points, which are no part of an arc.
    std::vector<BodyImage> earlier;
    for (const BodyImage& one : listed(body)) {
      if (one.direction == image.direction) break;
      if (size_of(one, radius) > spacing(one.direction)) earlier.push_back(one);
    }
    return lens_->sphere(observer_.null_time,
                         motion_of(observer_.spacetime, body, observer_.sky_from_tetrad), image,
                         earlier, radius, surface.rings(), spacing);
  }
  const double part = radius / image.r;
  // Two orders that meet in a ring are drawn in one way.
  const bool in_ring = image.psi > 1 && std::abs(std::sin(image.psi)) < 2 * part;
  const double off =
      in_ring ? std::min(half, size_of_sphere(image, radius) * part * part) : half * (half + part);
  const bool has_rings = !body.rings.empty();
  if (is_traced() && (off > error || has_rings)) {
    const BodyMotion motion = motion_of(observer_.spacetime, body, observer_.sky_from_tetrad);
    const auto place = [&](double r, double psi) {
      return lens_->place(observer_.null_time, r, psi);
    };
    const SphereView view{place, observer_.spacetime, observer_.r};
    if (has_rings) {
      if (auto pieces = traced_with_rings(view, motion, image, radius, surface.rings(), spacing))
        return std::move(*pieces);
    } else if (auto pieces = traced_sphere(view, motion, image, radius, spacing)) {
      return {std::move(*pieces), {}};
    }
  }
  if (!is_outside(image, radius)) return {};
  return {image_of_sphere(image, radius, spacing), {}};
}

BodySight::Seen BodySight::seen(const SkyImage& image) const {
  const AberratedLight at = to_observer(viewer_.celerity, image.direction.v);
  double g = image.frequency_ratio * at.frequency_ratio;
  if (viewer_.measured) g *= to_observer(*viewer_.measured, at.direction).frequency_ratio;
  return {{apply_transposed(observer_.tetrad_from_camera, at.direction)},
          received_flux(effects_, 1, image.amplification, at.frequency_ratio, g),
          g,
          at.frequency_ratio};
}

double BodySight::seen_v(const Body& body, const SkyImage& at,
                         const std::vector<Piece>& pieces) const {
  const auto v = [&](const SkyImage& image, double tint) {
    const Seen part = seen(image);
    return seen_magnitude(effects_, body.magnitude, body.temperature, part.brightening * tint,
                          part.frequency_ratio);
  };
  if (pieces.empty()) return v(at, 1);
  double light = 0;
  for (const Piece& piece : pieces)
    light += std::pow(10, -0.4 * v(piece.at, luminance(piece.tint)));
  return -2.5 * std::log10(light);
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
