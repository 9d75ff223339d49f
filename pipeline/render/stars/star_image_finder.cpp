#include "pipeline/render/stars/star_image_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/stars/einstein_rings.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A blob covers some pixels more than its reach, since it is blurred by their squares, and pixels
// on the rim of a dome lie partly beyond it.
constexpr double kBlurPixels = 4;

// Where an effect is left out, this many orders are always tried, since either side may be the
// bright one.  Beyond, the flux falls by exp(-2 pi) with every second order, so that the first
// faint order ends the series.
constexpr int kAlwaysTried = 4;
constexpr int kOrdersWithoutAmplification = 2;

// The spacing of the pieces of an arc in sigma.  A row of Gaussians at this distance is even to
// 2 exp(-2 pi^2/1.5^2) = 3e-4.
constexpr double kPieceSigmas = 1.5;

// The part of a star's light that the frame's limit of magnitude leaves.  Magnitudes are floats, so
// a hard limit is rounded as they were, lest a star on the limit be lost.
double part_within_limit(const FrameSettings::Sky& sky, double magnitude) {
  if (!sky.soft_limit) return magnitude <= double{static_cast<float>(sky.max_magnitude)} ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFadeMagnitudes, 0.0, 1.0);
}

double peak_per_lux(double exposure, const PointSpread& point_spread) {
  return exposure / (2 * pi * point_spread.least() * point_spread.least());
}

}  // namespace

StarImageFinder::StarImageFinder(const FrameScene& scene, SkyRegion sky)
    : scene_(scene),
      sky_(scene.state.settings.sky[sky]),
      observer_(scene.state.observer),
      vantage_(scene.tracer.vantage()),
      table_(scene.plan.gravity ? scene.optics.table_of(sky) : nullptr),
      from_tetrad_(-vantage_.celerity),
      to_measured_(-vantage_.measured.value_or(V3d(0, 0, 0))),
      from_rest_(vantage_.rest),
      straight_ratio_(scene.effects.lensing ? 1 : gravitational_ratio(observer_.r)),
      peak_per_lux_(peak_per_lux(scene.exposure, scene.point_spread)),
      stretch_(std::sqrt(1 + vantage_.celerity.length2()) + vantage_.celerity.length()),
      disc_(scene.point_spread.least() / stretch_),
      // The loops know all effects of nature and nothing else.
      in_batches_((scene.effects.lensing || is_flat(observer_)) && scene.effects.intensity &&
                  scene.effects.doppler_colour &&
                  scene.effects.amplification != Amplification::kNone && !vantage_.measured),
      plane_(scene.projection(),
             scene.point_spread.reach() + kBlurPixels * central_pixel_angle(scene.projection())) {
  in_batches_ = in_batches_ && plane_.usable();
  if (in_batches_) prepare_batches();
}

// The star with the gain and the limit of the frame applied to its flux, or nothing if none is
// left.
std::optional<SceneStar> StarImageFinder::with_gain(const SceneStar& catalogued) const {
  const double part = sky_.star_gain * part_within_limit(sky_, catalogued.magnitude);
  if (!(part > 0)) return std::nullopt;
  SceneStar star = catalogued;
  star.flux *= part;
  return star;
}

void StarImageFinder::append(const SceneStar& catalogued, std::vector<StarImage>& images) const {
  const auto star = with_gain(catalogued);
  if (star)
    append_orders(*star, apply_transposed(observer_.sky_from_tetrad, star->direction.v), 0, kOrders,
                  images);
}

// Appends the images of the orders from `first` to before `end`.
void StarImageFinder::append_orders(const SceneStar& star, const V3d& source, int first, int end,
                                    std::vector<StarImage>& images) const {
  if (table_ == nullptr) {
    append_order(star, source, 0, images);
    return;
  }
  const double sine = std::hypot(source.y, source.z);
  if (scene_.effects.amplification == Amplification::kNone)
    end = std::min(end, kOrdersWithoutAmplification);
  for (int order = first; order < end; ++order) {
    if (in_batches_ && !may_be_seen(star, sine, order)) return;
    const bool bright = append_order(star, source, order, images);
    if (!in_batches_ && !bright && order + 1 >= kAlwaysTried) return;
  }
}

// Whether the star may be bright enough in this order or a later one.  The amplification of a disc
// is the mean over its points, of which that of 1/(distance from the axis) is at most 2/radius.
bool StarImageFinder::may_be_seen(const SceneStar& star, double sine, int order) const {
  const double radius = std::max(disc_, star.angular_radius);
  const double least = sine < kNearAxis * radius ? radius / 2 : sine;
  return star.flux * bound_[static_cast<std::size_t>(order)] > least;
}

bool StarImageFinder::is_arc(const V3d& source, int order) const {
  const double near = kNearAxis * disc_;
  return table_ != nullptr && scene_.effects.lensing &&
         scene_.effects.amplification != Amplification::kNone &&
         source.y * source.y + source.z * source.z < near * near && on_caustic(source, order);
}

// The image of one order in the frame of the tetrad.
SkyImage StarImageFinder::image(const SceneStar& star, const V3d& source, int order) const {
  if (scene_.effects.lensing) return image_of(table_, source, order, star.angular_radius);
  const AberratedLight at = from_rest_.to_rest(source);
  const double ratio = at.frequency_ratio;
  return {{at.direction}, straight_ratio_ * ratio, 1 / (ratio * ratio)};
}

// The image as the camera receives it.  By [Riazuelo] sec. sec_stars_eff its magnitude is
// m + 10 log10(1+z) - 2.5 log10(f), with the amplification f, and its temperature is T/(1+z).
StarImageFinder::Received StarImageFinder::receive(const SceneStar& star,
                                                   const SkyImage& at) const {
  const AberratedLight seen = from_tetrad_.to_rest(at.direction.v);
  const double doppler = seen.frequency_ratio;
  double g = at.frequency_ratio * doppler;
  if (vantage_.measured) g *= to_measured_.to_rest(seen.direction).frequency_ratio;
  double flux = star.flux;
  if (scene_.effects.amplification != Amplification::kNone)
    flux *= at.amplification / (doppler * doppler);
  if (scene_.effects.intensity) flux = flux * g * g * g * g;
  if (!scene_.effects.doppler_colour) flux = std::min(flux, kSaturated);
  const WorkingRgb per_flux =
      blackbody_colours().per_flux(star.temperature * colour_ratio(scene_.effects, g));
  const auto pixel = pixel_of(scene_.projection(),
                              {apply_transposed(observer_.tetrad_from_camera, seen.direction)});
  const double pixel_flux = flux * scene_.exposure;
  Received received{{0, 0, {}}, luminance(per_flux) * flux * peak_per_lux_, pixel.has_value()};
  if (!pixel) return received;
  received.image = {
      static_cast<float>(pixel->i - 1),
      static_cast<float>(pixel->j - 1),
      {static_cast<float>(per_flux.r * pixel_flux), static_cast<float>(per_flux.g * pixel_flux),
       static_cast<float>(per_flux.b * pixel_flux)}};
  return received;
}

// Appends the image of one order.  Returns whether it is bright enough, even if it is beside the
// frame.
bool StarImageFinder::append_order(const SceneStar& star, const V3d& source, int order,
                                   std::vector<StarImage>& images) const {
  if (is_arc(source, order)) return append_arc(star, source, order, images);
  const Received received = receive(star, image(star, source, order));
  if (!(received.peak > kFaintestPeak)) return false;
  if (received.placed) images.push_back(received.image);
  return true;
}

bool StarImageFinder::append_arc(const SceneStar& star, const V3d& source, int order,
                                 std::vector<StarImage>& images) const {
  // The spacing is that of the frame, carried back through the boost.
  const auto spacing = [&](const V3d& direction) {
    return kPieceSigmas * scene_.point_spread.least() *
           from_tetrad_.to_rest(direction).frequency_ratio;
  };
  const std::size_t before = images.size();
  double peak = 0;
  for (const SkyImage& piece :
       arc_of(*table_, source, order, std::max(disc_, star.angular_radius), spacing)) {
    const Received received = receive(star, piece);
    peak = std::max(peak, received.peak);
    if (received.placed) images.push_back(received.image);
  }
  // In a row of Gaussians the sum of all is sqrt(2 pi)/spacing times the peak of one.
  const double neighbours = images.size() > before + 1 ? std::sqrt(2 * pi) / kPieceSigmas : 1;
  if (peak * neighbours > kFaintestPeak) return true;
  images.resize(before);
  return false;
}

}  // namespace domefall
