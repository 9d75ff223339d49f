// The time that a dome's stars take once their images are known: placing them, sorting them into
// bands and drawing them on one thread, for a catalogue's numbers of stars by magnitude.
//
//     build/release/tests/bench_blobs
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/scene/exposure.h"
#include "pipeline/report/frame_timing.h"
#include "pipeline/report/made_up_stars.h"

namespace domefall {
namespace {

using std::numbers::pi;

enum Law { kSize, kPsf };

// Images of the 2 * count brightest stars of the sky, of which a dome shows half, within an angle
// of its zenith and `gain` times as bright as they are.
std::vector<StarImage> stars(const Projection& p, std::size_t count, double within, double gain) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<StarImage> images(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double theta = std::acos(1 - (1 - std::cos(within)) * u(random)),
                 phi = 2 * pi * u(random);
    const auto at = pixel_of(
        p, {{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}});
    const double lux = kMagnitudeZeroLux *
                       std::pow(10, -0.4 * magnitude_of_rank(2.0 * static_cast<double>(k + 1)));
    const double flux = gain * lux * exposure_scale(FrameSettings{});
    images[k] = {static_cast<float>(at->i - 1),
                 static_cast<float>(at->j - 1),
                 {static_cast<float>(flux), static_cast<float>(0.95 * flux),
                  static_cast<float>(0.9 * flux)}};
  }
  std::shuffle(images.begin(), images.end(), random);
  return images;
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Cost {
  double place = 1e9, sort = 1e9, draw = 1e9;
};

void measure(const std::vector<StarImage>& images, const Projection& p, const PointSpread& widths,
             std::vector<float>& rgb, Cost& least) {
  BlobLayer layer(p);
  SplatBuffer buffer;
  if (BlobLayer::are_many(static_cast<double>(images.size()), p)) layer.use_splats(widths);
  const double start = cpu_seconds();
  layer.add(images, widths);
  const double placed = cpu_seconds();
  layer.sort_into_bands();
  const double sorted = cpu_seconds();
  layer.start_buffer(buffer);
  for (int band = 0; band < rows(p) / kBandRows; ++band) layer.draw_band(band, buffer, rgb.data());
  const double drawn = cpu_seconds();
  benchmark::DoNotOptimize(rgb.data());
  least.place = std::min(least.place, placed - start);
  least.sort = std::min(least.sort, sorted - placed);
  least.draw = std::min(least.draw, drawn - sorted);
}

void draw_stars(benchmark::State& state, double within, double gain) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const int size = static_cast<int>(state.range(0));
  const Projection p = Domemaster{size};
  const auto count = static_cast<std::size_t>(state.range(1));
  const std::vector<StarImage> images = stars(p, count, within, gain);
  PointSpreadLaw law{.min_sigma = 0.05 * pi / 180, .max_sigma = 0.3 * pi / 180, .white_core = 10};
  if (state.range(2) == kPsf) {
    law.halo = 0.15;
    law.halo_sigma = 0.2 * pi / 180;
  }
  const PointSpread widths(law, p, exposure_scale(FrameSettings{}));
  std::vector<float> rgb(static_cast<std::size_t>(3 * size) * kBandRows);
  Cost cost;
  for (auto _ : state) measure(images, p, widths, rgb, cost);
  const double total = cost.place + cost.sort + cost.draw;
  state.counters["place_ns"] = 1e9 * cost.place / static_cast<double>(count);
  state.counters["sort_ns"] = 1e9 * cost.sort / static_cast<double>(count);
  state.counters["draw_ns"] = 1e9 * cost.draw / static_cast<double>(count);
  state.counters["cpu_s"] = total;
  state.counters["copies"] = total / copy_seconds(HalfFrame(size, size));
}

void open_sky(benchmark::State& state) { draw_stars(state, pi / 2, 1); }

// All of the sky lies within a degree of the zenith and is a hundred million times as bright, as
// for a static observer at r = 2.0001.
void crowded_sky(benchmark::State& state) { draw_stars(state, pi / 180, 1e8); }

BENCHMARK(open_sky)
    ->ArgNames({"size", "stars", "psf"})
    ->ArgsProduct({{4096}, {4400, 59000, 625000, 1250000}, {kSize, kPsf}})
    ->ArgsProduct({{8192}, {1250000}, {kSize, kPsf}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(4);
BENCHMARK(crowded_sky)
    ->ArgNames({"size", "stars", "psf"})
    ->ArgsProduct({{4096}, {59000, 1250000}, {kSize, kPsf}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace domefall
