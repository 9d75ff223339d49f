#include "pipeline/render/star_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/effect_light.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Images up to this order are always tried, since either side may be the bright one; beyond, the
// flux falls by exp(-2 pi) with every second order and the first faint one ends the series.
constexpr int kAlwaysTried = 4, kLastOrder = 24;
constexpr int kWithoutAmplification = 2;

// The part of a star's light that a frame takes.
double part_taken(const Picture::Sky& sky, double magnitude) {
  constexpr double kFade = 0.5;  // magnitudes
  if (!sky.soft_limit) return magnitude <= sky.max_magnitude ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFade, 0.0, 1.0);
}

}  // namespace

StarImages::StarImages(const Show& show, const FrameState& state, const Picture::Sky& sky,
                       const SkyTable* table)
    : sky_(sky),
      effects_(show.effects),
      projection_(state.projection),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      tetrad_from_camera_(state.observer.tetrad_from_camera),
      vantage_(vantage_of(state.observer, show.effects)),
      from_tetrad_(-vantage_.celerity),
      to_measured_(-vantage_.measured.value_or(V3d(0, 0, 0))),
      from_rest_(vantage_.rest),
      straight_ratio_(effects_.lensing ? 1 : gravitational_ratio(state.observer.r)),
      table_(table),
      scale_(exposure_scale(state.picture)),
      widths_(show.blobs, projection_, scale_) {}

void StarImages::append(const SceneStar& catalogued, std::vector<StarImage>& images) const {
  const double taken = sky_.star_gain * part_taken(sky_, catalogued.magnitude);
  if (!(taken > 0)) return;
  SceneStar star = catalogued;
  star.flux *= taken;
  const V3d source = apply_transposed(sky_from_tetrad_, star.direction.v);
  if (table_ == nullptr) {
    append_image(star, source, 0, images);
    return;
  }
  const bool amplified = effects_.amplification != Amplification::kNone;
  const int orders = amplified ? kLastOrder : kWithoutAmplification;
  for (int order = 0; order < orders; ++order) {
    const bool bright = append_image(star, source, order, images);
    if (!bright && order + 1 >= kAlwaysTried) return;
  }
}

// In the frame of the tetrad.
SkyImage StarImages::image(const SceneStar& star, const V3d& source, int order) const {
  if (effects_.lensing) return image_of(table_, source, order, star.angular_radius);
  const AberratedLight at = from_rest_.to_rest(source);
  const double ratio = at.frequency_ratio;
  return {{at.direction}, straight_ratio_ * ratio, 1 / (ratio * ratio)};
}

// Whether the image is bright enough to matter, be it in the picture or not.
// [Riazuelo] sec. sec_stars_eff: m_obs = m + 10 log10(1+z) - 2.5 log10(f), T_obs = T/(1+z).
bool StarImages::append_image(const SceneStar& star, const V3d& source, int order,
                              std::vector<StarImage>& images) const {
  const SkyImage at = image(star, source, order);
  const AberratedLight seen = from_tetrad_.to_rest(at.direction.v);
  const double doppler = seen.frequency_ratio;
  double g = at.frequency_ratio * doppler;
  if (vantage_.measured) g *= to_measured_.to_rest(seen.direction).frequency_ratio;
  double flux = star.flux;
  if (effects_.amplification != Amplification::kNone)
    flux *= at.amplification / (doppler * doppler);
  if (effects_.intensity) flux = flux * g * g * g * g;
  if (!effects_.doppler_colour) flux = std::min(flux, kSaturated);
  const WorkingRgb per_flux =
      blackbody_colours().per_flux(star.temperature * colour_ratio(effects_, g));
  const double lux = luminance(per_flux) * flux;
  const double faintest_peak = lux * scale_ / (2 * pi * widths_.least() * widths_.least());
  if (!(faintest_peak > kFaintestPeak)) return false;
  const auto pixel = pixel_of(projection_, {apply_transposed(tetrad_from_camera_, seen.direction)});
  if (!pixel) return true;
  const double pixel_flux = flux * scale_;
  images.push_back(
      {static_cast<float>(pixel->i - 1),
       static_cast<float>(pixel->j - 1),
       {static_cast<float>(per_flux.r * pixel_flux), static_cast<float>(per_flux.g * pixel_flux),
        static_cast<float>(per_flux.b * pixel_flux)}});
  return true;
}

}  // namespace domefall
