// The light of stars that is in one frame of a show and in neither neighbour, in cells of a degree:
//     bench_star_flashes SHOW... [--instants] [--orbits N]
//
// --instants draws the stars of the very instant, as if the sky stood still, for comparison.
// --orbits adds N random orbits of 600 frames.  For each show it prints how many frames have a
// flash that is as bright as a star of magnitude 3, 2, 1, 0 and -1, and the five brightest.
//
// A star that drifts by less than three degrees a frame is no flash, because its light is compared
// with the brightest of the cells so far around in the frames before and after.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/observer_track.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

constexpr int kSize = 1024, kCells = 180, kCell = 6;  // pixels of a dome; cells of 1.05 degrees
constexpr int kAround = 3;                            // cells

using Cells = std::vector<float>;  // kCells x kCells, lux

// The light of all stars of a frame, by cells, without that of a view which vanishes.
Cells cells_of(const Show& show, const FrameState& state, SkyStore& skies, LensStore& lenses,
               bool instants) {
  Cells cells(static_cast<std::size_t>(kCells) * kCells, 0.0f);
  const FramePlan plan = plan_frame(show, state);
  const PerSky<const Sky*> loaded = skies.skies_of(plan);
  SkyMotion motion;
  if (plan.gravity && !instants) motion.turn = state.sky_turn;
  const FrameScene scene(show, state, plan,
                         lens_of(state.observer, plan.wanted(), show.effects, lenses), loaded,
                         motion);
  std::vector<StarImage> images;
  for (const SkyRegion sky : kEverySky) {
    if (scene.stars[sky] == nullptr) continue;
    const StarImageFinder finder(scene, sky);
    const std::size_t count = finder.count(*scene.stars[sky]);
    for (std::size_t k = 0; k < count; k += kStarBatch)
      finder.append(*scene.stars[sky], k, count, images);
  }
  for (const StarImage& image : images) {
    const int x = static_cast<int>(std::floor(image.x / kCell)),
              y = static_cast<int>(std::floor(image.y / kCell));
    if (x < 0 || y < 0 || x >= kCells || y >= kCells) continue;
    cells[static_cast<std::size_t>(y * kCells + x)] +=
        static_cast<float>(luminance({image.rgb[0], image.rgb[1], image.rgb[2]}) / scene.exposure);
  }
  return cells;
}

// The largest value of the cells around each cell.
Cells spread(const Cells& cells) {
  Cells most(cells.size());
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x)
      for (int j = std::max(0, y - kAround); j <= std::min(kCells - 1, y + kAround); ++j)
        for (int i = std::max(0, x - kAround); i <= std::min(kCells - 1, x + kAround); ++i) {
          float& m = most[static_cast<std::size_t>(y * kCells + x)];
          m = std::max(m, cells[static_cast<std::size_t>(j * kCells + i)]);
        }
  return most;
}

struct Flash {
  int frame = 0, x = 0, y = 0;  // the middle of the cell, pixels
  double magnitude = 99;
};

void report(const std::string& name, const Show& show, bool instants) {
  SkyStore skies(show, SkyDetail{1});
  LensStore lenses;
  const int frames = frame_count(show);
  std::array<Cells, 3> here, around;
  std::array<int, 5> as_bright{};
  std::vector<Flash> flashes;
  for (int frame = 0; frame < frames; ++frame) {
    FrameState state = frame_state(show, frame);
    state.projection = Domemaster{kSize};
    std::rotate(here.begin(), here.begin() + 1, here.end());
    std::rotate(around.begin(), around.begin() + 1, around.end());
    here[2] = cells_of(show, state, skies, lenses, instants);
    around[2] = spread(here[2]);
    // A cut is a change that the show asks for.
    if (frame < 2 || frame_state(show, frame - 2).segment != state.segment) continue;
    Flash flash;
    double most = 0;
    for (std::size_t k = 0; k < here[1].size(); ++k) {
      const double alone = here[1][k] - std::max(around[0][k], around[2][k]);
      if (alone <= most) continue;
      most = alone;
      const int x = static_cast<int>(k) % kCells, y = static_cast<int>(k) / kCells;
      flash = {frame - 1, x * kCell + kCell / 2, y * kCell + kCell / 2,
               -2.5 * std::log10(alone / kMagnitudeZeroLux)};
    }
    for (std::size_t m = 0; m < as_bright.size(); ++m)
      as_bright[m] += flash.magnitude < 3 - static_cast<double>(m) ? 1 : 0;
    flashes.push_back(flash);
  }
  std::ranges::sort(flashes, {}, &Flash::magnitude);
  fmt::print("{}: {} frames, with a flash above magnitude 3: {}, 2: {}, 1: {}, 0: {}, -1: {}\n",
             name, frames, as_bright[0], as_bright[1], as_bright[2], as_bright[3], as_bright[4]);
  for (std::size_t k = 0; k < std::min<std::size_t>(5, flashes.size()); ++k)
    fmt::print("    frame {:5} at {:4}, {:4}: magnitude {:.2f}\n", flashes[k].frame, flashes[k].x,
               flashes[k].y, flashes[k].magnitude);
}

Show random_orbit(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  Show show;
  show.spacetime = Schwarzschild{};
  show.projection = Domemaster{kSize};
  show.hole_at = {V3d(part(random) - 0.5, part(random) - 0.5, part(random) - 0.5).normalized()};
  for (const SkyRegion sky : kExteriorSkies)
    show.sky[sky].stars = StarField{source_file("shows/assets/stars_to_9.stars"), 6.5};
  Segment segment;
  segment.duration_s = 20;
  const CircularOrbit orbit{4 + 30 * part(random) * part(random)};
  segment.trajectory = orbit;
  segment.timing = {0, period(orbit) * (0.3 + 2 * part(random))};
  segment.camera.elevation = std::numbers::pi / 4;
  show.timeline = {segment};
  join_segments(show);
  return show;
}

int run(int count, char** arguments) {
  bool instants = false;
  std::vector<std::string> shows;
  int orbits = 0;
  for (int k = 1; k < count; ++k) {
    if (std::strcmp(arguments[k], "--instants") == 0)
      instants = true;
    else if (std::strcmp(arguments[k], "--orbits") == 0 && k + 1 < count)
      orbits = std::atoi(arguments[++k]);
    else
      shows.emplace_back(arguments[k]);
  }
  for (const std::string& show : shows) report(show, read_show(show), instants);
  std::mt19937 random(14);
  for (int k = 0; k < orbits; ++k)
    report(fmt::format("orbit {}", k + 1), random_orbit(random), instants);
  return 0;
}

}  // namespace
}  // namespace domefall

int main(int count, char** arguments) { return domefall::run(count, arguments); }
