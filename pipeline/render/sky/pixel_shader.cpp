#include "pipeline/render/sky/pixel_shader.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/rays/footprint_batch.h"
#include "pipeline/render/rays/pixel_directions.h"
#include "pipeline/render/scene/effect_light.h"
#include "pipeline/render/scene/photometry.h"
#include "pipeline/simd/vector_math.h"
#include "pipeline/sky/grid_sky.h"
#include "pipeline/sky/ring_glow.h"

namespace domefall {
namespace {

static_assert(kMostSamples <= FootprintBatch::kSize);  // a batch holds at least one line of looks
// A pixel this near (in pixels) to the edge of a sky is sampled finely.
constexpr double kEdgePixels = 4;
// On a grid, so is one whose footprint on the sky is longer than this (radians) and that elongated:
// blurring its sharp lines to that length would lose what it still resolves across.
constexpr double kLongOnGrid = 0.0005, kElongation = 3;
// Looks in a line of one of many samples in a pixel: the samples do most of the blurring.
constexpr int kTapsOfSample = 4;
// A footprint on a map longer than this is no straight line any more; it is blurred to its length.
constexpr float kLongestLine = 0.7f;

WorkingRgb operator*(const WorkingRgb& c, double k) {
  const auto f = static_cast<float>(k);
  return {c.r * f, c.g * f, c.b * f};
}

}  // namespace

PixelShader::PixelShader(const Show& show, const FrameState& state, const HoleOptics& optics,
                         const Skies& skies, AntiAliasing anti_aliasing,
                         std::vector<DarkenedCap> darkened)
    : show_(show),
      projection_(state.projection),
      tracer_(state, optics, show.effects),
      skies_(skies),
      darkened_(std::move(darkened)),
      anti_aliasing_(anti_aliasing),
      amplified_(show.effects.amplification == Amplification::kEverything),
      null_time_(state.observer.null_time) {
  for (const SkyRegion sky : kEverySky) {
    scale_[sky] = exposure_scale(state.settings) * state.settings.sky[sky].background_gain;
    if (const SkyMap* map = map_of(skies[sky])) samplers_[sky].emplace(*map);
  }
}

const SkySampler* PixelShader::sampler(SkyRegion sky) const {
  const auto& sampler = samplers_[sky];
  return sampler ? &*sampler : nullptr;
}

MapShift PixelShader::shift(SkyRegion sky, double frequency_ratio) const {
  return map_shift(samplers_[sky]->map(), show_, frequency_ratio, scale_[sky]);
}

// sample_angle: the angle of view that this look stands for; fine: it is one of many in its pixel.
WorkingRgb PixelShader::light(const ViewRayBatch& batch, int k, double sample_angle,
                              bool fine) const {
  const Sky* sky = skies_[batch.sky[k]];
  if (sky == nullptr) return {0, 0, 0};
  const double scale = scale_[batch.sky[k]];
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
double PixelShader::amplification(const CameraDirection& n, double pixel_angle) const {
  const ViewRay look = tracer_.trace(n);
  const bool sky = look.known && look.sky != SkyRegion::kIV;
  return sky ? domefall::amplification(look.bundle, pixel_angle) : 1;
}

bool PixelShader::is_darkened(SkyRegion sky, const CameraDirection& n) const {
  return std::any_of(darkened_.begin(), darkened_.end(), [&](const DarkenedCap& spot) {
    return spot.sky == sky && (n.v - spot.centre.v).length2() <= spot.chord2;
  });
}

bool PixelShader::needs_more_samples(const ViewRayBatch& batch, int k, double pixel_angle) const {
  if (anti_aliasing_.samples == 1) return false;
  if (anti_aliasing_.everywhere || batch.to_edge[k] < kEdgePixels * pixel_angle) return true;
  const Sky* sky = skies_[batch.sky[k]];
  if (sky == nullptr || std::holds_alternative<Rings>(sky->background))
    return false;  // blurred exactly
  const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
  const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
  if (!(longer > kElongation * shorter)) return false;
  return amplified_ ||
         (std::holds_alternative<Grid>(sky->background) && longer * pixel_angle > kLongOnGrid);
}

void PixelShader::shifts(SkyRegion sky, const double* frequency_ratio, int count, float* gain,
                         float* tone) const {
  map_shifts(samplers_[sky]->map(), show_, frequency_ratio, count, scale_[sky], gain, tone);
}

void PixelShader::shift_sides(SkyRegion sky, const double* frequency_ratio, int count, float* red,
                              float* blue) const {
  domefall::shift_sides(samplers_[sky]->map(), show_, frequency_ratio, count, scale_[sky], red,
                        blue);
}

float PixelShader::knee(SkyRegion sky) const {
  return domefall::knee(samplers_[sky]->map(), scale_[sky]);
}

struct PixelShader::Looks {
  static constexpr int kSize = FootprintBatch::kSize;
  int count = 0;
  alignas(64) std::array<double, kSize> i, j;   // positions in the picture
  alignas(64) std::array<double, kSize> angle;  // of the view, that a look stands for
  std::array<CameraDirection, kSize> n;
  std::array<bool, kSize> difficult;  // needs_more_samples
  std::array<float, 3 * kSize + 1> rgb;

  void add(double column, double row) {
    i[count] = column + 1, j[count] = row + 1;
    ++count;
  }
};

// The looks on maps among them.
struct PixelShader::Maps {
  FootprintBatch places;
  PerSky<std::array<SampleKind, FootprintBatch::kSize>> kinds{};  // none: not on that sky
  PerSky<bool> any{};
};

void PixelShader::put_maps(const ViewRayBatch& batch, const Looks& looks, int first, int count,
                           bool fine, Maps& maps) const {
  FootprintBatch& p = maps.places;
  set_footprints(batch, &looks.angle[first], count,
                 {&p.x[first], &p.y[first], &p.z[first], &p.wide[first], &p.narrow[first],
                  &p.ax[first], &p.ay[first], &p.az[first]});
  const bool few = fine && !anti_aliasing_.everywhere;
  const int most = few ? kTapsOfSample : SkySampler::kMostTaps;
  for (const SkyRegion sky : kEverySky) {
    const SkySampler* sampler = this->sampler(sky);
    const auto end = batch.sky.begin() + count;
    if (sampler == nullptr || std::find(batch.sky.begin(), end, sky) == end) continue;
    maps.any[sky] = true;
    SampleKind* kinds = &maps.kinds[sky][first];
    sampler->choose_kinds(&p.wide[first], &p.narrow[first], count, most, kLongestLine, kinds);
    ViewRayBatch::Column<float> gain, tone;
    shifts(sky, batch.frequency_ratio.data(), count, gain.data(), tone.data());
    for (int k = 0; k < count; ++k) {
      const int at = first + k;
      if (batch.sky[k] == sky) p.gain[at] = gain[k], p.tone[at] = tone[k];
      if (batch.sky[k] != sky || looks.difficult[at] || is_darkened(sky, looks.n[at]))
        kinds[k] = SampleKind();
    }
  }
}

void PixelShader::shade_batch(Looks& looks, int first, int count, bool fine, Maps& maps) const {
  ViewRayBatch batch;
  tracer_.trace(&looks.n[first], count, batch);
  bool maps_seen = false;
  float* rgb = &looks.rgb[3 * first];
  for (int k = 0; k < count; ++k, rgb += 3) {
    const int at = first + k;
    looks.difficult[at] = !fine && needs_more_samples(batch, k, looks.angle[at]);
    const bool map = sampler(batch.sky[k]) != nullptr;
    maps_seen |= map;
    WorkingRgb c{0, 0, 0};
    if (!map && !looks.difficult[at] && !is_darkened(batch.sky[k], looks.n[at]))
      c = light(batch, k, looks.angle[at], fine);
    rgb[0] = c.r, rgb[1] = c.g, rgb[2] = c.b;
  }
  if (maps_seen) put_maps(batch, looks, first, count, fine, maps);
}

void PixelShader::shade(Looks& looks, bool fine) const {
  view_directions(projection_, looks.i.data(), looks.j.data(), looks.count, looks.n.data(),
                  looks.angle.data());
  const int samples = fine ? anti_aliasing_.samples : 1;
  if (fine)
    for (int k = 0; k < looks.count; ++k) looks.angle[k] /= samples;
  Maps maps;
  for (int first = 0; first < looks.count; first += ViewRayBatch::kSize)
    shade_batch(looks, first, std::min(ViewRayBatch::kSize, looks.count - first), fine, maps);
  for (const SkyRegion sky : kEverySky)
    if (maps.any[sky])
      sampler(sky)->sample(maps.places, looks.count, maps.kinds[sky].data(), looks.rgb.data());
  if (!amplified_) return;
  for (int k = 0; k < looks.count; ++k) {
    const auto by = static_cast<float>(amplification(looks.n[k], looks.angle[k] * samples));
    for (int c = 0; c < 3; ++c) looks.rgb[3 * k + c] *= by;
  }
}

// Each of these pixels becomes the mean of a square of looks.  The squares' lines follow one another, as many
// at once as there is room for, so that a square may be larger than that.
void PixelShader::supersample(const std::vector<Pixel>& pixels, int first_row, float* rgb) const {
  const int samples = anti_aliasing_.samples, at_once = Looks::kSize / samples;
  const int lines = static_cast<int>(pixels.size()) * samples;
  const double step = 1.0 / samples, start = step / 2 - 0.5;
  Looks looks;
  float sum[3] = {0, 0, 0};
  for (int first = 0; first < lines; first += at_once) {
    const int end = std::min(lines, first + at_once);
    looks.count = 0;
    for (int line = first; line < end; ++line) {
      const Pixel& pixel = pixels[line / samples];
      for (int k = 0; k < samples; ++k)
        looks.add(pixel.column + start + k * step, pixel.row + start + line % samples * step);
    }
    shade(looks, true);
    const float* sample = looks.rgb.data();
    for (int line = first; line < end; ++line) {
      for (int k = 0; k < samples; ++k, sample += 3)
        for (int c = 0; c < 3; ++c) sum[c] += sample[c];
      if (line % samples != samples - 1) continue;
      float* out = this->pixel(pixels[line / samples], first_row, rgb);
      for (int c = 0; c < 3; ++c)
        out[c] = sum[c] / static_cast<float>(samples * samples), sum[c] = 0;
    }
  }
}

void PixelShader::fill(const std::vector<Pixel>& pixels, int first_row, float* rgb) const {
  Looks looks;
  std::vector<Pixel> difficult;
  for (std::size_t first = 0; first < pixels.size(); first += Looks::kSize) {
    const std::size_t end = std::min(pixels.size(), first + Looks::kSize);
    looks.count = 0;
    for (std::size_t k = first; k < end; ++k) looks.add(pixels[k].column, pixels[k].row);
    shade(looks, false);
    const float* value = looks.rgb.data();
    for (std::size_t k = first; k < end; ++k, value += 3)
      if (looks.difficult[k - first])
        difficult.push_back(pixels[k]);
      else
        std::copy_n(value, 3, pixel(pixels[k], first_row, rgb));
  }
  supersample(difficult, first_row, rgb);
}

}  // namespace domefall
