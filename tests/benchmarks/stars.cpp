// What finding the images of stars costs a 4k dome frame, by the size of the catalogue: nanoseconds of CPU
// time a star, and copies of the frame.  Star counts are those of Tycho-2 by magnitude; the catalogue
// named by DOMEFALL_STARS is taken instead if there is one.
//
//     build/release/tests/bench_stars
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/star_images.h"

namespace domefall {
namespace {

constexpr int kSize = 4096;

// V, and how many stars of Tycho-2 are brighter.
struct Count {
  double magnitude, stars;
};
constexpr std::array<Count, 8> kCounts{{{-1.5, 1},
                                        {6.5, 8805},
                                        {8, 45630},
                                        {9, 130720},
                                        {10, 357145},
                                        {11, 945959},
                                        {12, 2083385},
                                        {13, 2543829}}};

double magnitude_of_rank(double rank) {
  std::size_t k = 1;
  while (k + 1 < kCounts.size() && kCounts[k].stars < rank) ++k;
  const Count &a = kCounts[k - 1], &b = kCounts[k];
  return a.magnitude +
         (b.magnitude - a.magnitude) * std::log(rank / a.stars) / std::log(b.stars / a.stars);
}

std::vector<Star> made_up(std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> b_v(-0.2, 1.8);
  std::vector<Star> stars(count);
  for (std::size_t k = 0; k < count; ++k) {
    const V3d v(normal(random), normal(random), normal(random));
    stars[k] = {{v.normalized()},
                static_cast<float>(magnitude_of_rank(static_cast<double>(k) + 1)),
                static_cast<float>(temperature_from_b_v(b_v(random)))};
  }
  return stars;
}

const std::vector<Star>& all_stars() {
  static const std::vector<Star> stars = [] {
    const char* file = std::getenv("DOMEFALL_STARS");
    return file ? read_star_catalogue(file, 99).stars : made_up(2'543'829);
  }();
  return stars;
}

double cpu_seconds() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return static_cast<double>(use.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(use.ru_utime.tv_usec);
}

// CPU seconds of copying a frame: the unit.
double copy_seconds() {
  const HalfFrame frame(kSize, kSize);
  HalfFrame copy(kSize, kSize);
  double best = 1e9;
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    std::memcpy(copy.pixels.data(), frame.pixels.data(), frame.pixels.size() * 2);
    benchmark::DoNotOptimize(copy.pixels.data());
    benchmark::ClobberMemory();
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

struct Place {
  const char* name;
  double r;
  V3d celerity;
};
const std::array<Place, 5> kPlaces{{{"flat", kFlatSpace, V3d(0, 0, 0)},
                                    {"r = 100", 100, V3d(0.1, 0, 0)},
                                    {"r = 7", 7, V3d(0.2, 0.3, 0)},
                                    {"r = 2.001", 2.001, V3d(0, 0.3, 0)},
                                    {"r = 1", 1, V3d(0, 0, 0)}}};

void find_images(benchmark::State& bench) {
  const Place& place = kPlaces[static_cast<std::size_t>(bench.range(0))];
  const auto number = std::min(static_cast<std::size_t>(bench.range(1)), all_stars().size());
  const SceneStars stars(
      std::vector<Star>(all_stars().begin(), all_stars().begin() + static_cast<long>(number)));
  Show show;
  show.projection = Domemaster{kSize};
  FrameState state;
  state.projection = show.projection;
  state.observer.r = place.r;
  state.observer.celerity = place.celerity;
  const bool flat = place.r == kFlatSpace;
  const HoleOptics optics = make_hole_optics(place.r, Tetrad::kRain, {true, false});
  std::vector<StarImage> images;
  double best = 1e9;
  for (auto _ : bench) {
    const double start = cpu_seconds();
    images.clear();
    const StarImages maker(show, state, {1, 1, 99}, flat ? nullptr : &*optics.home_sky);
    const std::size_t count = maker.count(stars);
    for (std::size_t k = 0; k < count; k += kStarBatch) maker.append(stars, k, count, images);
    best = std::min(best, cpu_seconds() - start);
  }
  bench.SetLabel(place.name);
  bench.counters["ns_per_star"] = best * 1e9 / static_cast<double>(number);
  bench.counters["cpu_ms"] = best * 1e3;
  bench.counters["copies"] = best / copy_seconds();
  bench.counters["images"] = static_cast<double>(images.size());
}

BENCHMARK(find_images)
    ->ArgNames({"place", "stars"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {118000, 2543829}})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace domefall
