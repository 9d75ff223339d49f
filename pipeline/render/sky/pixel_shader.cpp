#include "pipeline/render/sky/pixel_shader.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "pipeline/render/rays/footprint_batch.h"
#include "pipeline/sources/sky/formula_sky.h"
#include "projections/pixel_directions.h"

namespace domefall {
namespace {

static_assert(kMostSamples <= SampleBatch::kSize);  // a batch holds at least one line of samples
static_assert(ViewRayBatch::kSize <= SkyLight::kMostShifts);
// A pixel is supersampled if it is nearer than this to the edge of a sky, in pixels.
constexpr double kEdgePixels = 4;
// It is also supersampled if its footprint is this elongated, where backgrounds are amplified.
constexpr double kElongation = 3;
// One of many samples in a pixel has at most this many taps along its footprint, because the
// samples do most of the blurring.
constexpr int kTapsOfSample = 4;
// A footprint on a map that is longer than this (radians) is no longer a straight line.  It is
// blurred as widely as it is long.
constexpr float kLongestSampleLine = 0.7f;

}  // namespace

PixelShader::PixelShader(const FrameScene& scene, AntiAliasing anti_aliasing,
                         std::vector<DarkenedCap> darkened)
    : scene_(scene), darkened_(std::move(darkened)), anti_aliasing_(anti_aliasing) {
  for (const SkyRegion sky : kEverySky) {
    const auto& background = scene.background[sky];
    if (!background) continue;
    if (background->map())
      samplers_[sky].emplace(*background->map(), background->black());
    else
      formulas_[sky].emplace(*background, scene.state.observer.null_time, anti_aliasing.samples);
  }
}

// GridSamples holds what those rays see that end on grids.
struct PixelShader::GridSamples {
  std::array<std::uint8_t, ViewRayBatch::kSize> places;  // by ray: its place in the columns
  ViewRayBatch::Column<float> squares, discs, even;
};

bool PixelShader::is_grid(SkyRegion sky) const {
  return scene_.background[sky] && scene_.background[sky]->is_grid();
}

void PixelShader::find_grids(const ViewRayBatch& rays, const double* angle, int count, bool fine,
                             GridSamples& grid) const {
  if (std::ranges::none_of(kEverySky, [this](SkyRegion sky) { return is_grid(sky); })) return;
  ViewRayBatch::Column<double> x, y, z, footprint, reach;
  int places = 0;
  for (int k = 0; k < count; ++k) {
    if (!is_grid(rays.sky[k])) continue;
    const double longer = rays.longer(k), shorter = rays.shorter(k);
    grid.places[k] = static_cast<std::uint8_t>(places);
    x[places] = rays.sky_x[k];
    y[places] = rays.sky_y[k];
    z[places] = rays.sky_z[k];
    // Many samples do the blurring themselves.  A box as long as the longer side of their
    // footprints would also smear the lines of a grid along the shorter side, and on an Einstein
    // ring the longer side grows without bound.
    footprint[places] = angle[k] * (fine ? shorter : longer);
    reach[places] = kGridReach * longer * angle[k];
    ++places;
  }
  grid_lights({x.data(), y.data(), z.data(), footprint.data(), reach.data()}, places,
              {grid.squares.data(), grid.discs.data(), grid.even.data()});
}

// Returns the light of a ray that ends on no map.  The ray stands for `sample_angle` radians of the
// view.
WorkingRgb PixelShader::light(const ViewRayBatch& rays, int k, double sample_angle,
                              const GridSamples& grid) const {
  const auto& background = scene_.background[rays.sky[k]];
  if (!background) return {0, 0, 0};
  if (const Rings* rings = background->rings())
    return background->rings_at(
        (scene_.state.observer.null_time + rays.emission_time[k]) / rings->period,
        rays.time_scale[k] * sample_angle / rings->period);
  if (!is_grid(rays.sky[k])) return {0, 0, 0};
  const std::size_t place = grid.places[k];
  return background->grid_at({grid.squares[place], grid.discs[place]}, rays.frequency_ratio[k]);
}

// Returns the amplification of a whole pixel, so that caustics have the same brightness however
// finely the pixel is sampled.
double PixelShader::amplification(const CameraDirection& n, double pixel_angle) const {
  const ViewRay ray = scene_.tracer.trace(n);
  const bool sky = ray.known && ray.sky != SkyRegion::kIV;
  return sky ? domefall::amplification(ray.bundle, pixel_angle) : 1;
}

bool PixelShader::is_darkened(SkyRegion sky, const CameraDirection& n) const {
  return std::ranges::any_of(darkened_, [&](const DarkenedCap& cap) {
    return cap.sky == sky && (n.v - cap.centre.v).length2() <= cap.chord2;
  });
}

bool PixelShader::needs_more_samples(const ViewRayBatch& rays, int k, double pixel_angle,
                                     const GridSamples& grid) const {
  if (anti_aliasing_.samples == 1) return false;
  if (anti_aliasing_.everywhere || rays.to_edge[k] < kEdgePixels * pixel_angle) return true;
  const auto& background = scene_.background[rays.sky[k]];
  // A formula averages the light of rings over footprints (ring_glow), so they need no more
  // samples.
  if (!background || background->rings() != nullptr) return false;
  if (rays.longer(k) > kElongation * rays.shorter(k) && scene_.amplifies_backgrounds()) return true;
  return is_grid(rays.sky[k]) && grid.even[grid.places[k]] == 0;
}

// Samples are positions in the image, and the light found there.
struct PixelShader::Samples {
  static constexpr int kSize = SampleBatch::kSize;
  int count = 0;
  alignas(64) std::array<double, kSize> i, j;   // pixels, counted from 1
  alignas(64) std::array<double, kSize> angle;  // radians of the view that a sample stands for
  std::array<CameraDirection, kSize> n;
  std::array<bool, kSize> difficult;  // see needs_more_samples
  std::array<float, 3 * kSize + 1> rgb;

  void add(double column, double row) {
    i[count] = column + 1;
    j[count] = row + 1;
    ++count;
  }
};

// MapSamples holds the same samples as the maps see them.  A sample that does not end on the map of
// a sky has no taps on it.
struct PixelShader::MapSamples {
  SampleBatch batch;
  PerSky<std::array<SampleFilter, SampleBatch::kSize>> filters{};
  PerSky<bool> any{};
};

void PixelShader::put_maps(const ViewRayBatch& rays, const Samples& samples, int first, int count,
                           bool fine, MapSamples& maps) const {
  SampleBatch& batch = maps.batch;
  set_footprints(rays, &samples.angle[first], count,
                 {&batch.x[first], &batch.y[first], &batch.z[first], &batch.wide[first],
                  &batch.narrow[first], &batch.ax[first], &batch.ay[first], &batch.az[first]});
  // In a reference image, where all pixels have many samples, each sample may have as many taps as
  // a pixel elsewhere.
  const bool few = fine && !anti_aliasing_.everywhere;
  const int most = few ? kTapsOfSample : SkySampler::kMostTaps;
  for (const SkyRegion sky : kEverySky) {
    const SkySampler* sampler = this->sampler(sky);
    const auto end = rays.sky.begin() + count;
    if (sampler == nullptr || std::find(rays.sky.begin(), end, sky) == end) continue;
    maps.any[sky] = true;
    SampleFilter* filters = &maps.filters[sky][first];
    sampler->choose_filters(&batch.wide[first], &batch.narrow[first], count, most,
                            kLongestSampleLine, filters);
    ViewRayBatch::Column<float> gain, tone;
    scene_.background[sky]->shifts(rays.frequency_ratio.data(), count, gain.data(), tone.data());
    for (int k = 0; k < count; ++k) {
      const int at = first + k;
      if (rays.sky[k] == sky) {
        batch.gain[at] = gain[k];
        batch.tone[at] = tone[k];
      }
      // A sample without taps is not taken.  Difficult pixels get their samples later.
      if (rays.sky[k] != sky || samples.difficult[at] || is_darkened(sky, samples.n[at]))
        filters[k] = SampleFilter();
    }
  }
}

void PixelShader::shade_batch(Samples& samples, int first, int count, bool fine,
                              MapSamples& maps) const {
  ViewRayBatch rays;
  scene_.tracer.trace(&samples.n[first], count, rays);
  GridSamples grid;
  find_grids(rays, &samples.angle[first], count, fine, grid);
  bool maps_seen = false;
  float* rgb = &samples.rgb[3 * first];
  for (int k = 0; k < count; ++k, rgb += 3) {
    const int at = first + k;
    // Fine samples are not divided any further.
    samples.difficult[at] = !fine && needs_more_samples(rays, k, samples.angle[at], grid);
    const bool map = sampler(rays.sky[k]) != nullptr;
    maps_seen |= map;
    // Samples of maps are taken later, many at a time (put_maps).
    WorkingRgb c{0, 0, 0};
    if (!map && !samples.difficult[at] && !is_darkened(rays.sky[k], samples.n[at]))
      c = light(rays, k, samples.angle[at], grid);
    rgb[0] = c.r;
    rgb[1] = c.g;
    rgb[2] = c.b;
  }
  if (maps_seen) put_maps(rays, samples, first, count, fine, maps);
}

void PixelShader::shade(Samples& samples, bool fine) const {
  find_directions(scene_.projection(), samples.i.data(), samples.j.data(), samples.count,
                  samples.n.data(), samples.angle.data());
  // amplification() needs the angle of the whole pixel, which is per_side times that of a sample.
  const int per_side = fine ? anti_aliasing_.samples : 1;
  if (fine)
    for (int k = 0; k < samples.count; ++k) samples.angle[k] /= per_side;
  MapSamples maps;
  for (int first = 0; first < samples.count; first += ViewRayBatch::kSize)
    shade_batch(samples, first, std::min(ViewRayBatch::kSize, samples.count - first), fine, maps);
  // The call for a sky writes only the samples that have taps on its map.
  for (const SkyRegion sky : kEverySky)
    if (maps.any[sky])
      sampler(sky)->sample(maps.batch, samples.count, maps.filters[sky].data(), samples.rgb.data());
  if (!scene_.amplifies_backgrounds()) return;
  for (int k = 0; k < samples.count; ++k) {
    const auto by = static_cast<float>(amplification(samples.n[k], samples.angle[k] * per_side));
    for (int c = 0; c < 3; ++c) samples.rgb[3 * k + c] *= by;
  }
}

// Makes each of these pixels the mean of a square of samples.  A square may have more samples than
// fit into one batch.  The lines of all squares therefore form one sequence, which is shaded in
// batches, and `sum` carries over from one batch to the next.
void PixelShader::supersample(const std::vector<Pixel>& pixels, int first_row, float* rgb) const {
  const int per_side = anti_aliasing_.samples, at_once = Samples::kSize / per_side;
  const int lines = static_cast<int>(pixels.size()) * per_side;
  // The samples are the middles of per_side^2 equal parts of the pixel.
  const double step = 1.0 / per_side, start = step / 2 - 0.5;
  Samples samples;
  float sum[3] = {0, 0, 0};
  for (int first = 0; first < lines; first += at_once) {
    const int end = std::min(lines, first + at_once);
    samples.count = 0;
    for (int line = first; line < end; ++line) {
      const Pixel& pixel = pixels[line / per_side];
      for (int k = 0; k < per_side; ++k)
        samples.add(pixel.column + start + k * step, pixel.row + start + line % per_side * step);
    }
    shade(samples, true);
    const float* sample = samples.rgb.data();
    for (int line = first; line < end; ++line) {
      for (int k = 0; k < per_side; ++k, sample += 3)
        for (int c = 0; c < 3; ++c) sum[c] += sample[c];
      if (line % per_side != per_side - 1) continue;
      float* out = this->pixel(pixels[line / per_side], first_row, rgb);
      for (int c = 0; c < 3; ++c) {
        out[c] = sum[c] / static_cast<float>(per_side * per_side);
        sum[c] = 0;
      }
    }
  }
}

void PixelShader::fill(const std::vector<Pixel>& pixels, int first_row, float* rgb) const {
  Samples samples;
  // A first pass with one sample for each pixel also finds the difficult pixels.
  std::vector<Pixel> difficult;
  for (std::size_t first = 0; first < pixels.size(); first += Samples::kSize) {
    const std::size_t end = std::min(pixels.size(), first + Samples::kSize);
    samples.count = 0;
    for (std::size_t k = first; k < end; ++k) samples.add(pixels[k].column, pixels[k].row);
    shade(samples, false);
    const float* value = samples.rgb.data();
    for (std::size_t k = first; k < end; ++k, value += 3)
      if (samples.difficult[k - first])
        difficult.push_back(pixels[k]);
      else
        std::copy_n(value, 3, pixel(pixels[k], first_row, rgb));
  }
  supersample(difficult, first_row, rgb);
}

}  // namespace domefall
