// What reading a binary star catalogue costs, from the page cache, beside copying its bytes: two
// million stars drawn by lot, as many as Tycho-2 has nearly.
//
//     build/release/tests/bench_catalogue
#include <benchmark/benchmark.h>

#include <cstring>
#include <filesystem>
#include <random>
#include <vector>

#include "pipeline/base/temporary_file.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_file.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr int kStars = 2'000'000;
constexpr double kFaintest = 12;

// Written once, gone with the program.
const std::filesystem::path& file() {
  static const ScratchFolder folder;
  static const std::filesystem::path path = [] {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> ra(0, 360), dec(-90, 90);
    RawCatalogue raw;
    raw.stars.resize(kStars);
    for (int i = 0; i < kStars; ++i) {
      CatalogueStar& star = raw.stars[static_cast<std::size_t>(i)];
      star.direction = sky_direction(ra(random), dec(random));
      star.v = static_cast<float>(kFaintest * i / kStars);
      star.colour = static_cast<float>(i % 20) * 0.1F;
      star.pm_ra = static_cast<float>(i % 50), star.pm_dec = 3;
    }
    write_star_file(folder / "drawn.stars", raw);
    return folder / "drawn.stars";
  }();
  return path;
}

void read(benchmark::State& state, double limit, double epoch) {
  file();
  for (auto _ : state) benchmark::DoNotOptimize(read_star_catalogue(file(), limit, epoch));
}

void copy(benchmark::State& state) {
  const std::vector<char> from(std::filesystem::file_size(file()), 1);
  std::vector<char> to(from.size());
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size());
    benchmark::ClobberMemory();
  }
}

BENCHMARK(copy)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, all, kFaintest, 2000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, all_moved, kFaintest, 2026.5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read, a_twentieth, kFaintest / 20, 2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace domefall
