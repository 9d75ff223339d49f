#include "pipeline/render/pixel_light.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/effect_light.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/vector_math.h"
#include "pipeline/sky/grid_sky.h"
#include "pipeline/sky/ring_glow.h"

namespace domefall {
namespace {

static_assert(kMostSamples <= LookBatch::kSize);  // a batch holds at least one line of looks
// A pixel this near (in pixels) to the edge of a sky is sampled finely.
constexpr double kEdgePixels = 4;
// So is one whose footprint on the sky is longer than this (radians) and that elongated: blurring it
// to its length would lose what it still resolves across.  A grid has sharp lines, a panorama's
// texels are softer.
constexpr double kLongOnGrid = 0.0005, kLongOnPanorama = 0.01, kElongation = 3;

bool is_grid(const Sky* sky) { return sky && std::holds_alternative<Grid>(sky->background); }

WorkingRgb operator*(const WorkingRgb& c, double k) {
  const auto f = static_cast<float>(k);
  return {c.r * f, c.g * f, c.b * f};
}

// [Riazuelo] sec. ssec_rgb: what a panorama without spectra does under a frequency ratio
// g = 1/(1+z): keep its hue and scale by a power for blueshift, by an exponential for redshift.
double panorama_intensity(const PanoramaShift& shift, double g) {
  if (g < 1) return exponential(1 - 1 / g);
  return shift.blueshift_power == 2 ? g * g : std::pow(g, shift.blueshift_power);
}

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

PixelLight::PixelLight(const Show& show, const FrameState& state, const HoleOptics& optics,
                       const Skies& skies, AntiAliasing anti_aliasing,
                       std::vector<DarkenedSpot> darkened)
    : show_(show),
      projection_(state.projection),
      tracer_(state, optics, show.effects),
      skies_(skies),
      darkened_(std::move(darkened)),
      anti_aliasing_(anti_aliasing),
      long_footprint_(std::any_of(skies.begin(), skies.end(), is_grid) ? kLongOnGrid
                                                                       : kLongOnPanorama),
      amplified_(show.effects.amplification == Amplification::kEverything),
      null_time_(state.observer.null_time) {
  for (const SeenSky sky : kEverySky)
    scale_[static_cast<std::size_t>(sky)] =
        exposure_scale(state.picture) * sky_of(state.picture, sky).background_gain;
}

// sample_angle: the angle of view that this look stands for; fine: it is one of many in its pixel.
WorkingRgb PixelLight::light(const LookBatch& batch, int k, double sample_angle, bool fine) const {
  const Sky* sky = skies_[static_cast<std::size_t>(batch.sky[k])];
  if (sky == nullptr) return {0, 0, 0};
  const double scale = scale_[static_cast<std::size_t>(batch.sky[k])];
  const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
  if (const auto* rings = std::get_if<Rings>(&sky->background))
    return ring_glow((null_time_ + batch.emission_time[k]) / rings->period,
                     batch.time_scale[k] * sample_angle / rings->period) *
           scale;
  const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
  // Many looks do the blurring themselves; a box as long as each would also smear the lines of a grid
  // across it, which on an Einstein ring are stretched without bound.
  const bool short_box = fine && std::holds_alternative<Grid>(sky->background);
  return background_light(*sky, show_, batch.sky_direction(k),
                          sample_angle * (short_box ? shorter : longer), batch.frequency_ratio[k],
                          scale);
}

// Of the image of a whole pixel: however finely it is sampled, its caustics are as bright.
double PixelLight::amplification(const CameraDirection& n, double pixel_angle) const {
  const Look look = tracer_.look(n);
  const bool sky = look.known && look.sky != SeenSky::kFour;
  return sky ? domefall::amplification(look.bundle, pixel_angle) : 1;
}

bool PixelLight::is_darkened(SeenSky sky, const CameraDirection& n) const {
  return std::any_of(darkened_.begin(), darkened_.end(), [&](const DarkenedSpot& spot) {
    return spot.sky == sky && (n.v - spot.centre.v).length2() <= spot.chord2;
  });
}

bool PixelLight::needs_more_samples(const LookBatch& batch, int k, double pixel_angle) const {
  if (anti_aliasing_.samples == 1) return false;
  if (anti_aliasing_.everywhere || batch.to_edge[k] < kEdgePixels * pixel_angle) return true;
  const Sky* sky = skies_[static_cast<std::size_t>(batch.sky[k])];
  if (sky && std::holds_alternative<Rings>(sky->background)) return false;  // blurred exactly
  const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
  const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
  if (amplified_ && sky && longer > kElongation * shorter) return true;
  return longer * pixel_angle > long_footprint_ && longer > kElongation * shorter;
}

void PixelLight::shade(const LookBatch& batch, const CameraDirection* n, int count,
                       const double* sample_angle, bool fine, float* rgb) const {
  for (int k = 0; k < count; ++k, rgb += 3) {
    WorkingRgb c{0, 0, 0};
    if (darkened_.empty() || !is_darkened(batch.sky[k], n[k]))
      c = light(batch, k, sample_angle[k], fine);
    if (amplified_)
      c = c * amplification(n[k], sample_angle[k] * (fine ? anti_aliasing_.samples : 1));
    rgb[0] = c.r, rgb[1] = c.g, rgb[2] = c.b;
  }
}

// Each of these pixels becomes the mean of a square of looks.  The squares' lines follow one another
// through the batches, as many at once as one holds, so that a square may be larger than a batch.
void PixelLight::supersample(int row, const std::vector<int>& pixels, float* rgb) const {
  const int samples = anti_aliasing_.samples, at_once = LookBatch::kSize / samples;
  const Projection finer = refined(projection_, samples);
  const int lines = static_cast<int>(pixels.size()) * samples;
  LookBatch batch;
  std::array<CameraDirection, LookBatch::kSize> n;
  std::array<double, LookBatch::kSize> angle;
  std::array<float, 3 * LookBatch::kSize> fine;
  float sum[3] = {0, 0, 0};
  for (int first = 0; first < lines; first += at_once) {
    const int end = std::min(lines, first + at_once);
    int count = 0;
    for (int line = first; line < end; ++line, count += samples) {
      const int pixel = pixels[line / samples];
      std::fill_n(angle.begin() + count, samples,
                  pixel_angle(projection_, {pixel + 1.0, row + 1.0}) / samples);
      inside_directions(finer, samples * row + line % samples,
                        {samples * pixel, samples * (pixel + 1) - 1}, n.data() + count);
    }
    tracer_.look(n.data(), count, batch);
    shade(batch, n.data(), count, angle.data(), true, fine.data());
    const float* sample = fine.data();
    for (int line = first; line < end; ++line) {
      for (int k = 0; k < samples; ++k, sample += 3)
        for (int c = 0; c < 3; ++c) sum[c] += sample[c];
      if (line % samples != samples - 1) continue;
      float* out = rgb + 3 * pixels[line / samples];
      for (int c = 0; c < 3; ++c)
        out[c] = sum[c] / static_cast<float>(samples * samples), sum[c] = 0;
    }
  }
}

void PixelLight::fill_row(int row, float* rgb) const {
  const ColumnRange inside = inside_columns(projection_, row);
  std::fill_n(rgb, 3 * columns(projection_), 0.0f);
  LookBatch batch;
  std::array<CameraDirection, LookBatch::kSize> n;
  std::array<double, LookBatch::kSize> angle;
  std::vector<int> fine;
  for (int first = inside.first; first <= inside.last; first += LookBatch::kSize) {
    const int last = std::min(inside.last, first + LookBatch::kSize - 1), count = last - first + 1;
    inside_directions(projection_, row, {first, last}, n.data());
    for (int k = 0; k < count; ++k)
      angle[static_cast<std::size_t>(k)] = pixel_angle(projection_, {first + k + 1.0, row + 1.0});
    tracer_.look(n.data(), count, batch);
    shade(batch, n.data(), count, angle.data(), false, rgb + 3 * first);
    for (int k = 0; k < count; ++k)
      if (needs_more_samples(batch, k, angle[static_cast<std::size_t>(k)]))
        fine.push_back(first + k);
  }
  supersample(row, fine, rgb);
}

}  // namespace domefall
