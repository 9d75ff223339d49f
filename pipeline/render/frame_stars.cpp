#include "pipeline/render/frame_stars.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "pipeline/render/photometry.h"
#include "pipeline/render/star_images.h"

namespace domefall {
namespace {

// Whose images one task finds, however many threads there are; of many stars, more.
std::size_t stars_per_task(std::size_t count) {
  constexpr std::size_t kLeast = 16 * kStarBatch, kTasks = 64;
  return std::max(kLeast, count / kTasks / kStarBatch * kStarBatch);
}
// Each task's stars in a place of their own, in the catalogue's order: the same images in the same order
// for any number of threads.  `lists`: whatever is in them goes, their memory stays.
void add_stars(const StarImages& maker, const SceneStars& stars, const BlobWidths& widths,
               ImageLists& lists, StarLayer& layer) {
  const std::size_t count = maker.count(stars);
  const std::size_t each = stars_per_task(count), tasks = (count + each - 1) / each;
  const std::size_t before = layer.new_tasks(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t first = task * each, end = std::min(count, first + each);
    std::vector<StarImage>& images = lists.local();
    images.clear();
    for (std::size_t k = first; k < end; k += kStarBatch) maker.append(stars, k, end, images);
    layer.place(before + task, images, widths);
  });
}

// Of a sky with stars; null in flat space.
const SkyTable* table_of(const HoleOptics& optics, SeenSky which) {
  const bool home = (which == SeenSky::kThree) == is_mirrored(optics.tetrad);
  const auto& table = home ? optics.home_sky : optics.far_sky;
  return table ? &*table : nullptr;
}

// About as many as a picture will have, by its part of the sphere; falling at 7 M a dome has two of each star.
double images_expected(std::size_t stars, bool gravity, const Projection& p) {
  const double pixel = central_pixel_angle(p);
  const double part =
      std::holds_alternative<Domemaster>(p)
          ? 0.5
          : std::min(1.0, pixel * pixel * columns(p) * rows(p) / (4 * std::numbers::pi));
  return static_cast<double>(stars) * part * (gravity ? 4 : 1);
}

}  // namespace

void lay_stars(const Show& show, const FrameState& state, const FramePlan& plan,
               const HoleOptics& optics, const PixelLight::Skies& skies, ImageLists& lists,
               StarLayer& layer) {
  const BlobWidths widths(show.blobs, state.projection, exposure_scale(state.picture));
  std::array<std::optional<StarImages>, kSkies> makers;
  double many = 0;
  for (const SeenSky which : kEverySky) {
    if (!plan[which].stars) continue;
    const auto k = static_cast<std::size_t>(which);
    makers[k].emplace(show, state, sky_of(state.picture, which), table_of(optics, which));
    many += images_expected(makers[k]->count(*skies[k]->stars), plan.gravity, state.projection);
  }
  if (StarLayer::are_many(many, state.projection)) layer.use_dots(widths);
  for (std::size_t k = 0; k < kSkies; ++k)
    if (makers[k]) add_stars(*makers[k], *skies[k]->stars, widths, lists, layer);
}

}  // namespace domefall
