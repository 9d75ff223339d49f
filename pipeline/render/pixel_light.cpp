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
// On a grid, so is one whose footprint on the sky is longer than this (radians) and that elongated:
// blurring its sharp lines to that length would lose what it still resolves across.
constexpr double kLongOnGrid = 0.0005, kElongation = 3;
// Looks in a line of one of many samples in a pixel: the samples do most of the blurring.
constexpr int kTapsOfSample = 4;
// A footprint on a map longer than this is no straight line any more; it is blurred to its length.
constexpr double kLongestLine = 0.7;

WorkingRgb operator*(const WorkingRgb& c, double k) {
  const auto f = static_cast<float>(k);
  return {c.r * f, c.g * f, c.b * f};
}

}  // namespace

PixelLight::PixelLight(const Show& show, const FrameState& state, const HoleOptics& optics,
                       const Skies& skies, AntiAliasing anti_aliasing,
                       std::vector<DarkenedSpot> darkened)
    : show_(show),
      projection_(state.projection),
      tracer_(state, optics, show.effects),
      skies_(skies),
      darkened_(std::move(darkened)),
      anti_aliasing_(anti_aliasing),
      amplified_(show.effects.amplification == Amplification::kEverything),
      null_time_(state.observer.null_time) {
  for (const SeenSky sky : kEverySky) {
    const auto k = static_cast<std::size_t>(sky);
    scale_[k] = exposure_scale(state.picture) * sky_of(state.picture, sky).background_gain;
    if (const SkyMap* map = map_of(skies[k])) samplers_[k].emplace(*map);
  }
}

const SkySampler* PixelLight::sampler(SeenSky sky) const {
  const auto& sampler = samplers_[static_cast<std::size_t>(sky)];
  return sampler ? &*sampler : nullptr;
}

MapShift PixelLight::shift(SeenSky sky, double frequency_ratio) const {
  const auto k = static_cast<std::size_t>(sky);
  return map_shift(samplers_[k]->map(), show_, frequency_ratio, scale_[k]);
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
  if (sky == nullptr || std::holds_alternative<Rings>(sky->background))
    return false;  // blurred exactly
  const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
  const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
  if (!(longer > kElongation * shorter)) return false;
  return amplified_ ||
         (std::holds_alternative<Grid>(sky->background) && longer * pixel_angle > kLongOnGrid);
}

ShiftSides PixelLight::shift_sides(SeenSky sky, double frequency_ratio) const {
  const auto k = static_cast<std::size_t>(sky);
  return domefall::shift_sides(samplers_[k]->map(), show_, frequency_ratio, scale_[k]);
}

float PixelLight::knee(SeenSky sky) const {
  const auto k = static_cast<std::size_t>(sky);
  return domefall::knee(samplers_[k]->map(), scale_[k]);
}

// The looks on a map, in groups of as many taps each.
void PixelLight::add_map(SeenSky sky, const LookBatch& batch, const CameraDirection* n, int count,
                         const double* sample_angle, bool fine, float* rgb) const {
  const SkySampler& sampler = *this->sampler(sky);
  const bool few = fine && !anti_aliasing_.everywhere;
  const int most = few ? kTapsOfSample : SkySampler::kMostTaps;
  std::array<int, LookBatch::kSize> taps{};  // 0: none
  for (int k = 0; k < count; ++k) {
    if (batch.sky[k] != sky || is_darkened(sky, n[k])) continue;
    const double longer = std::max(batch.radial_scale[k], batch.tangential_scale[k]);
    const double shorter = std::min(batch.radial_scale[k], batch.tangential_scale[k]);
    const double wide = longer * sample_angle[k];
    taps[k] = wide < kLongestLine ? sampler.taps(wide, shorter * sample_angle[k], most) : 1;
  }
  SkyPlaces places;
  std::array<int, LookBatch::kSize> who;
  std::array<float, 3 * LookBatch::kSize + 1> light;
  for (int left = count; left > 0;) {
    int at_once = 0, members = 0;
    bool minified = false;
    left = 0;
    for (int k = 0; k < count; ++k) {
      if (taps[k] == 0) continue;
      if (at_once == 0) at_once = taps[k];
      if (taps[k] != at_once) {
        ++left;
        continue;
      }
      minified |= put_place(sky, batch, k, sample_angle[k], at_once, places, members);
      who[members++] = k;
      taps[k] = 0;
    }
    if (members == 0) return;
    sampler.sample(places, members, at_once, minified, light.data());
    for (int m = 0; m < members; ++m) std::copy_n(&light[3 * m], 3, rgb + 3 * who[m]);
  }
}

bool PixelLight::put_place(SeenSky sky, const LookBatch& batch, int k, double sample_angle,
                           int taps, SkyPlaces& places, int member) const {
  const bool radial = batch.radial_scale[k] >= batch.tangential_scale[k];
  const double wide = sample_angle * (radial ? batch.radial_scale[k] : batch.tangential_scale[k]);
  const double narrow = sample_angle * (radial ? batch.tangential_scale[k] : batch.radial_scale[k]);
  const V3d on_sky = batch.sky_direction(k);
  const V3d along = (radial ? batch.along(k) : batch.along(k).cross(on_sky)) * wide;
  const MapShift shifted = shift(sky, batch.frequency_ratio[k]);
  const auto set = [member](SkyPlaces::Column& column, double value) {
    column[static_cast<std::size_t>(member)] = static_cast<float>(value);
  };
  set(places.x, on_sky.x), set(places.y, on_sky.y), set(places.z, on_sky.z);
  set(places.gain, shifted.gain), set(places.tone, shifted.tone);
  set(places.wide, wide), set(places.narrow, narrow);
  set(places.ax, along.x), set(places.ay, along.y), set(places.az, along.z);
  return this->sampler(sky)->is_minified(wide, narrow, taps);
}

void PixelLight::shade(const LookBatch& batch, const CameraDirection* n, int count,
                       const double* sample_angle, bool fine, float* rgb) const {
  for (const SeenSky sky : kEverySky)
    if (sampler(sky)) add_map(sky, batch, n, count, sample_angle, fine, rgb);
  for (int k = 0; k < count; ++k, rgb += 3) {
    WorkingRgb c{0, 0, 0};
    if (!is_darkened(batch.sky[k], n[k])) {
      if (sampler(batch.sky[k]))
        c = {rgb[0], rgb[1], rgb[2]};
      else
        c = light(batch, k, sample_angle[k], fine);
    }
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

void PixelLight::fill(int row, ColumnRange range, float* rgb) const {
  const ColumnRange in_picture = inside_columns(projection_, row);
  const ColumnRange inside{std::max(in_picture.first, range.first),
                           std::min(in_picture.last, range.last)};
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
