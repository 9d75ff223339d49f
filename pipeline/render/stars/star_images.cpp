#include "pipeline/render/stars/star_images.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/scene/effect_light.h"
#include "pipeline/render/scene/photometry.h"
#include "pipeline/render/stars/star_arcs.h"

namespace domefall {
namespace {

// A blob is blurred by the pixels' squares, and a rim's pixels lie partly beyond it.
constexpr double kBlurPixels = 4;

using std::numbers::pi;

// Where an effect is left out, images up to this order are always tried, since either side may be
// the bright one; beyond, the flux falls by exp(-2 pi) with every second order and the first faint
// one ends the series.
constexpr int kAlwaysTried = 4;
constexpr int kWithoutAmplification = 2;

constexpr double kFade = 0.5;  // magnitudes

// Pieces of an arc are so many sigma apart: its light is even to 2 exp(-2 pi^2/1.5^2), 3e-4.
constexpr double kPieceSigmas = 1.5;

// The part of a star's light that a frame takes.  Magnitudes are floats: so is a limit that some
// have.
double part_taken(const FrameSettings::Sky& sky, double magnitude) {
  if (!sky.soft_limit) return magnitude <= double{static_cast<float>(sky.max_magnitude)} ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFade, 0.0, 1.0);
}

double peak_per_lux(double scale, const PointSpread& widths) {
  return scale / (2 * pi * widths.least() * widths.least());
}

}  // namespace

StarImages::StarImages(const FrameScene& scene, SkyRegion sky)
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
      plain_((scene.effects.lensing || is_flat(observer_)) && scene.effects.intensity &&
             scene.effects.doppler_colour && scene.effects.amplification != Amplification::kNone &&
             !vantage_.measured),
      plane_(scene.projection(),
             scene.point_spread.reach() + kBlurPixels * central_pixel_angle(scene.projection())) {
  plain_ = plain_ && plane_.usable();
  if (plain_) prepare_batches();
}

// ---- one star at a time ----

std::optional<SceneStar> StarImages::taken(const SceneStar& catalogued) const {
  const double part = sky_.star_gain * part_taken(sky_, catalogued.magnitude);
  if (!(part > 0)) return std::nullopt;
  SceneStar star = catalogued;
  star.flux *= part;
  return star;
}

void StarImages::append(const SceneStar& catalogued, std::vector<StarImage>& images) const {
  const auto star = taken(catalogued);
  if (star)
    append_orders(*star, apply_transposed(observer_.sky_from_tetrad, star->direction.v), 0,
                  kLastOrder, images);
}

// Orders first to before end.
void StarImages::append_orders(const SceneStar& star, const V3d& source, int first, int end,
                               std::vector<StarImage>& images) const {
  if (table_ == nullptr) {
    append_order(star, source, 0, images);
    return;
  }
  const double sine = std::hypot(source.y, source.z);
  if (scene_.effects.amplification == Amplification::kNone)
    end = std::min(end, kWithoutAmplification);
  for (int order = first; order < end; ++order) {
    if (plain_ && !may_be_seen(star, sine, order)) return;
    const bool bright = append_order(star, source, order, images);
    if (!plain_ && !bright && order + 1 >= kAlwaysTried) return;
  }
}

// A disc's amplification is that of its points in the mean, and the mean of 1/(their distance from
// the axis) is at most 2/radius.
bool StarImages::may_be_seen(const SceneStar& star, double sine, int order) const {
  const double radius = std::max(disc_, star.angular_radius);
  const double least = sine < kNearAxis * radius ? radius / 2 : sine;
  return star.flux * bound_[static_cast<std::size_t>(order)] > least;
}

bool StarImages::is_arc(const V3d& source, int order) const {
  const double near = kNearAxis * disc_;
  return table_ != nullptr && scene_.effects.lensing &&
         scene_.effects.amplification != Amplification::kNone &&
         source.y * source.y + source.z * source.z < near * near && on_caustic(source, order);
}

// In the frame of the tetrad.
SkyImage StarImages::image(const SceneStar& star, const V3d& source, int order) const {
  if (scene_.effects.lensing) return image_of(table_, source, order, star.angular_radius);
  const AberratedLight at = from_rest_.to_rest(source);
  const double ratio = at.frequency_ratio;
  return {{at.direction}, straight_ratio_ * ratio, 1 / (ratio * ratio)};
}

// [Riazuelo] sec. sec_stars_eff: m_obs = m + 10 log10(1+z) - 2.5 log10(f), T_obs = T/(1+z).
StarImages::Received StarImages::receive(const SceneStar& star, const SkyImage& at) const {
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

// Whether the image is bright enough to matter, be it in the picture or not.
bool StarImages::append_order(const SceneStar& star, const V3d& source, int order,
                              std::vector<StarImage>& images) const {
  if (is_arc(source, order)) return append_arc(star, source, order, images);
  const Received received = receive(star, image(star, source, order));
  if (!(received.peak > kFaintestPeak)) return false;
  if (received.placed) images.push_back(received.image);
  return true;
}

bool StarImages::append_arc(const SceneStar& star, const V3d& source, int order,
                            std::vector<StarImage>& images) const {
  // As wide as it was before the boost.
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
  const double neighbours = images.size() > before + 1 ? std::sqrt(2 * pi) / kPieceSigmas : 1;
  if (peak * neighbours > kFaintestPeak) return true;
  images.resize(before);
  return false;
}

}  // namespace domefall
