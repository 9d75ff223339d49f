#include "pipeline/render/scene/sky_light.h"

#include <algorithm>
#include <cmath>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/scene/effect_light.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/vector_math.h"
#include "pipeline/sky/grid_sky.h"

namespace domefall {
namespace {

WorkingRgb operator*(const WorkingRgb& c, double k) {
  const auto f = static_cast<float>(k);
  return {c.r * f, c.g * f, c.b * f};
}

// [Riazuelo] sec. ssec_rgb: what a panorama without spectra does under a frequency ratio
// g = 1/(1+z): keep its hue and scale by an exponential for redshift, by a power for blueshift.
double redshifted(double g) { return exponential(1 - 1 / g); }
double blueshifted(const PanoramaShift& shift, double g) {
  return shift.blueshift_power == 2 ? g * g : std::pow(g, shift.blueshift_power);
}
double panorama_intensity(const PanoramaShift& shift, double g) {
  return g < 1 ? redshifted(g) : blueshifted(shift, g);
}

// Whatever is as bright is white, and stays finite times a texel and a colour.
constexpr double kMostGain = 1e28;
float gain_of(const SkyMap& map, double shift, double scale) {
  return static_cast<float>(std::min(map.unit() * shift * scale, kMostGain));
}

// gain_of(redshifted) and gain_of(blueshifted) for many frequency ratios.
[[gnu::always_inline]] inline void red_gains_loop(const double* g, int count, double unit,
                                                  double scale, float* gain) {
  for (int k = 0; k < count; ++k) {
    const double wanted = unit * redshifted(g[k]) * scale;
    gain[k] = static_cast<float>(wanted < kMostGain ? wanted : kMostGain);
  }
}
Dispatched<red_gains_loop> red_gains;

[[gnu::always_inline]] inline void square_gains_loop(const double* g, int count, double unit,
                                                     double scale, float* gain) {
  for (int k = 0; k < count; ++k) {
    const double wanted = unit * (g[k] * g[k]) * scale;
    gain[k] = static_cast<float>(wanted < kMostGain ? wanted : kMostGain);
  }
}
Dispatched<square_gains_loop> square_gains;

[[gnu::always_inline]] inline void choose_loop(const float* red, const float* blue, const double* g,
                                               int count, float* gain) {
  for (int k = 0; k < count; ++k) gain[k] = g[k] < 1 ? red[k] : blue[k];
}
Dispatched<choose_loop> choose;

// A thermal map has spectra: its blackbodies are seen at g T, as stars are.  In double until the end,
// since g^4 may be far beyond a float where the colour, per unit of light, is as far below it.
WorkingRgb thermal_light(const ThermalLight& light, const Effects& effects, double g) {
  const double ratio = colour_ratio(effects, g), ratio2 = ratio * ratio;
  const WorkingRgb c = blackbody_colours().per_flux(light.temperature * ratio);
  const double radiance = light.radiance * ratio2 * ratio2 * surface_brightness_ratio(effects, g);
  const auto seen = [radiance](float of) {
    return static_cast<float>(std::min(of * radiance, kSaturated));
  };
  return {seen(c.r), seen(c.g), seen(c.b)};
}

}  // namespace

WorkingRgb background_light(const Sky& sky, const Show& show, const V3d& sky_direction,
                            double footprint, double g, double scale) {
  const Effects& effects = show.effects;
  if (const auto* map = std::get_if<std::shared_ptr<const SkyMap>>(&sky.background)) {
    if ((*map)->kind() == SkyMapKind::kThermal)
      return thermal_light((*map)->sample_thermal(sky_direction, footprint), effects, g) * scale;
    const double shift = effects.intensity ? panorama_intensity(show.panorama_shift, g) : 1;
    return (*map)->sample(sky_direction, footprint) * (shift * scale);
  }
  if (!std::holds_alternative<Grid>(sky.background)) return {0, 0, 0};
  return grid_light({sky_direction}, footprint, colour_ratio(effects, g)) *
         (surface_brightness_ratio(effects, g) * scale);
}

MapShift map_shift(const SkyMap& map, const Show& show, double g, double scale) {
  const Effects& effects = show.effects;
  if (map.kind() == SkyMapKind::kColour)
    return {gain_of(map, effects.intensity ? panorama_intensity(show.panorama_shift, g) : 1, scale),
            0};
  const double ratio = colour_ratio(effects, g), ratio2 = ratio * ratio;
  return {gain_of(map, ratio2 * ratio2 * surface_brightness_ratio(effects, g), scale),
          static_cast<float>(std::log2(ratio))};
}

void map_shifts(const SkyMap& map, const Show& show, const double* g, int count, double scale,
                float* gain, float* tone) {
  if (map.kind() == SkyMapKind::kThermal) {
    for (int k = 0; k < count; ++k) {
      const MapShift shift = map_shift(map, show, g[k], scale);
      gain[k] = shift.gain, tone[k] = shift.tone;
    }
    return;
  }
  std::fill_n(tone, count, 0.0f);
  if (!show.effects.intensity) {
    std::fill_n(gain, count, gain_of(map, 1, scale));
    return;
  }
  std::array<float, kMostShifts> red, blue;
  shift_sides(map, show, g, count, scale, red.data(), blue.data());
  choose(red.data(), blue.data(), g, count, gain);
}

void shift_sides(const SkyMap& map, const Show& show, const double* g, int count, double scale,
                 float* red, float* blue) {
  if (!show.effects.intensity) {
    std::fill_n(red, count, gain_of(map, 1, scale));
    std::fill_n(blue, count, gain_of(map, 1, scale));
    return;
  }
  red_gains(g, count, map.unit(), scale, red);
  if (show.panorama_shift.blueshift_power == 2)
    square_gains(g, count, map.unit(), scale, blue);
  else
    for (int k = 0; k < count; ++k)
      blue[k] = gain_of(map, blueshifted(show.panorama_shift, g[k]), scale);
}

ShiftSides shift_sides(const SkyMap& map, const Show& show, double g, double scale) {
  if (!show.effects.intensity) return {gain_of(map, 1, scale), gain_of(map, 1, scale)};
  return {gain_of(map, redshifted(g), scale),
          gain_of(map, blueshifted(show.panorama_shift, g), scale)};
}

}  // namespace domefall
