// What finding the images of stars costs a 4k dome frame, by the size of the catalogue: nanoseconds
// of CPU time a star, and copies of the frame.  Star counts are those of Tycho-2 by magnitude; the
// catalogue named by DOMEFALL_STARS is taken instead if there is one.
//
//     build/release/tests/bench_stars
#include <benchmark/benchmark.h>

#include <array>
#include <cstdlib>

#include "pipeline/base/stop_watch.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/report/frame_timing.h"
#include "pipeline/report/made_up_stars.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"

namespace domefall {
namespace {

constexpr int kSize = 4096;

std::vector<Star> made_up(std::size_t count) {
  std::vector<Star> stars;
  stars.reserve(count);
  for (const CatalogueStar& star : made_up_stars(count).stars)
    stars.push_back(
        {star.direction, star.v, static_cast<float>(temperature_from_b_v(star.colour))});
  return stars;
}

const std::vector<Star>& all_stars() {
  static const std::vector<Star> stars = [] {
    const char* file = std::getenv("DOMEFALL_STARS");
    return file ? read_star_catalogue(file, 99).stars : made_up(kMostMadeUpStars);
  }();
  return stars;
}

struct Place {
  const char* name;
  double r;
  Celerity<ReferenceTetrad> celerity;
};
const std::array<Place, 5> kPlaces{{{"flat", kFlatSpace, {0, 0, 0}},
                                    {"r = 100", 100, {0.1, 0, 0}},
                                    {"r = 7", 7, {0.2, 0.3, 0}},
                                    {"r = 2.001", 2.001, {0, 0.3, 0}},
                                    {"r = 1", 1, {0, 0, 0}}}};

void find_images(benchmark::State& bench) {
  const Place& place = kPlaces[static_cast<std::size_t>(bench.range(0))];
  const auto number = std::min(static_cast<std::size_t>(bench.range(1)), all_stars().size());
  const SceneStars stars(
      std::vector<Star>(all_stars().begin(), all_stars().begin() + static_cast<long>(number)));
  Show show;
  show.projection = Domemaster{kSize};
  FrameState state;
  state.projection = show.projection;
  if (place.r != kFlatSpace) state.observer.spacetime = Schwarzschild{};
  state.observer.r = place.r;
  state.observer.celerity = place.celerity;
  state.settings.sky[SkyRegion::kI] = {1, 1, 99};
  const FrameScene scene(show, state, plan_frame(show, state),
                         lens_of(state.observer, {{true, false}}, show.effects), {});
  std::vector<StarImage> images;
  double best = 1e9;
  for (auto _ : bench) {
    const double start = processor_seconds();
    images.clear();
    const StarImageFinder maker(scene, SkyRegion::kI);
    const std::size_t count = maker.count(stars);
    for (std::size_t k = 0; k < count; k += kStarBatch) maker.append(stars, k, count, images);
    best = std::min(best, processor_seconds() - start);
  }
  bench.SetLabel(place.name);
  bench.counters["ns_per_star"] = best * 1e9 / static_cast<double>(number);
  bench.counters["cpu_ms"] = best * 1e3;
  bench.counters["copies"] = best / copy_seconds(HalfFrame(kSize, kSize));
  bench.counters["images"] = static_cast<double>(images.size());
}

BENCHMARK(find_images)
    ->ArgNames({"place", "stars"})
    ->ArgsProduct({{0, 1, 2, 3, 4}, {118000, 2543829}})
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace domefall
