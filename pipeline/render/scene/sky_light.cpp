#include "pipeline/render/scene/sky_light.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/formula_sky.h"

namespace domefall {
namespace {

WorkingRgb operator*(const WorkingRgb& c, double k) {
  const auto f = static_cast<float>(k);
  return {c.r * f, c.g * f, c.b * f};
}

// These are the factors to the intensity of a panorama without spectra, on both sides of g = 1.  It
// falls by an exponential of the redshift and grows by a power of the blueshift
// ([Riazuelo] sec. ssec_rgb).  Both factors are 1 at g = 1.
double redshifted(double g) { return exponential(1 - 1 / g); }
double blueshifted(const PanoramaShift& shift, double g) {
  return shift.blueshift_power == 2 ? g * g : std::pow(g, shift.blueshift_power);
}

// A gain beyond this is white in any frame.  The bound keeps the product with a texel and a colour
// finite.
constexpr double kMostGain = 1e28;

// Computes gain_of(redshifted(g)) for many frequency ratios.  The factors stand in the order of
// gain_of, so that both give the same bits.
[[gnu::always_inline]] inline void red_gains_loop(const double* g, int count, double unit,
                                                  double scale, float* gain) {
  for (int k = 0; k < count; ++k) {
    const double wanted = unit * redshifted(g[k]) * scale;
    gain[k] = static_cast<float>(wanted < kMostGain ? wanted : kMostGain);
  }
}
Dispatched<red_gains_loop> red_gains;

// Computes gain_of(blueshifted(g)) for many frequency ratios and the power 2.
[[gnu::always_inline]] inline void square_gains_loop(const double* g, int count, double unit,
                                                     double scale, float* gain) {
  for (int k = 0; k < count; ++k) {
    const double wanted = unit * (g[k] * g[k]) * scale;
    gain[k] = static_cast<float>(wanted < kMostGain ? wanted : kMostGain);
  }
}
Dispatched<square_gains_loop> square_gains;

[[gnu::always_inline]] inline void choose_side_loop(const float* red, const float* blue,
                                                    const double* g, int count, float* gain) {
  for (int k = 0; k < count; ++k) gain[k] = g[k] < 1 ? red[k] : blue[k];
}
Dispatched<choose_side_loop> choose_side;

// Returns thermal light as it is seen: the blackbodies of a map are seen at g T, as stars are.  The
// product stays a double until the end, since g^4 may be far too large for a float where the colour
// per unit of light is far too small.
WorkingRgb thermal_light(const ThermalLight& light, const Effects& effects, double g) {
  const double ratio = colour_ratio(effects, g), ratio2 = ratio * ratio;
  const WorkingRgb c = blackbody_colours().per_flux(light.temperature * ratio);
  const double radiance = light.radiance * ratio2 * ratio2 * surface_brightness_ratio(effects, g);
  const auto seen = [radiance](float of) {
    return static_cast<float>(std::min(of * radiance, kSaturated));
  };
  return {seen(c.r), seen(c.g), seen(c.b)};
}

const SkyMap* map_of(const Sky& sky) {
  const auto* map = std::get_if<std::shared_ptr<const SkyMap>>(&sky.background);
  return map ? map->get() : nullptr;
}

}  // namespace

SkyLight::SkyLight(const Sky& sky, const Effects& effects, const PanoramaShift& panorama_shift,
                   double scale)
    : sky_(&sky),
      map_(map_of(sky)),
      effects_(effects),
      panorama_shift_(panorama_shift),
      scale_(scale),
      black_(map_ ? sky.black.light / map_->unit() : 0) {}

double SkyLight::intensity(double g) const {
  if (!effects_.intensity) return 1;
  return g < 1 ? redshifted(g) : blueshifted(panorama_shift_, g);
}

float SkyLight::gain_of(double intensity) const {
  return static_cast<float>(std::min(map_->unit() * intensity * scale_, kMostGain));
}

WorkingRgb SkyLight::at(const V3d& sky_direction, double footprint, double g) const {
  if (map_ != nullptr) {
    const double black = black_ * map_->unit();
    if (map_->kind() == SkyMapKind::kThermal) {
      ThermalLight light = map_->sample_thermal(sky_direction, footprint);
      light.radiance = std::max(0.0, light.radiance - black);
      return thermal_light(light, effects_, g) * scale_;
    }
    const WorkingRgb light = map_->sample(sky_direction, footprint);
    // All three channels shrink by one factor, which keeps the hue.
    const double seen = luminance(light);
    if (!(seen > black)) return {0, 0, 0};
    return light * ((1 - black / seen) * (intensity(g) * scale_));
  }
  if (!std::holds_alternative<Grid>(sky_->background)) return {0, 0, 0};
  return grid_at(grid_light({sky_direction}, footprint), g);
}

WorkingRgb SkyLight::grid_at(const GridLight& light, double g) const {
  return grid_colour(light, colour_ratio(effects_, g)) *
         (surface_brightness_ratio(effects_, g) * scale_);
}

LightShift SkyLight::grid_shift(double g) const {
  return {static_cast<float>(std::min(surface_brightness_ratio(effects_, g) * scale_, kMostGain)),
          static_cast<float>(colour_ratio(effects_, g))};
}

WorkingRgb SkyLight::ring_colour() const { return domefall::ring_colour() * scale_; }

WorkingRgb SkyLight::rings_at(double phase, double width) const {
  return ring_glow(phase, width) * scale_;
}

LightShift SkyLight::shift(double g) const {
  if (map_->kind() == SkyMapKind::kColour) return {gain_of(intensity(g)), 0};
  // Of a thermal map the colour is looked up by the shifted temperature, per unit of bolometric
  // light, so that the gain has the whole fourth power.
  const double ratio = colour_ratio(effects_, g), ratio2 = ratio * ratio;
  return {gain_of(ratio2 * ratio2 * surface_brightness_ratio(effects_, g)),
          static_cast<float>(std::log2(ratio))};
}

void SkyLight::shifts(const double* g, int count, float* gain, float* tone) const {
  if (map_->kind() == SkyMapKind::kThermal) {
    for (int k = 0; k < count; ++k) {
      const LightShift one = shift(g[k]);
      gain[k] = one.gain;
      tone[k] = one.tone;
    }
    return;
  }
  std::fill_n(tone, count, 0.0f);
  if (!effects_.intensity) {
    std::fill_n(gain, count, gain_of(1));
    return;
  }
  std::array<float, kMostShifts> red, blue;
  shift_sides(g, count, red.data(), blue.data());
  choose_side(red.data(), blue.data(), g, count, gain);
}

void SkyLight::shift_sides(const double* g, int count, float* red, float* blue) const {
  if (!effects_.intensity) {
    std::fill_n(red, count, gain_of(1));
    std::fill_n(blue, count, gain_of(1));
    return;
  }
  red_gains(g, count, map_->unit(), scale_, red);
  if (panorama_shift_.blueshift_power == 2)
    square_gains(g, count, map_->unit(), scale_, blue);
  else
    for (int k = 0; k < count; ++k) blue[k] = gain_of(blueshifted(panorama_shift_, g[k]));
}

float SkyLight::knee() const { return static_cast<float>(map_->unit() * scale_); }

}  // namespace domefall
