#include "pipeline/render/frame_stars.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "pipeline/render/scene/photometry.h"
#include "pipeline/render/stars/star_images.h"

namespace domefall {
namespace {

// Whose images one task finds, however many threads there are; of many stars, more.
std::size_t stars_per_task(std::size_t count) {
  constexpr std::size_t kLeast = 16 * kStarBatch, kTasks = 64;
  return std::max(kLeast, count / kTasks / kStarBatch * kStarBatch);
}
// Each task's stars in a place of their own, in the catalogue's order: the same images in the same order
// for any number of threads.  `lists`: whatever is in them goes, their memory stays.
void add_stars(const StarImages& maker, const SceneStars& stars, const PointSpread& widths,
               ImageLists& lists, BlobLayer& layer) {
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
               const HoleOptics& optics, const PixelShader::Skies& skies, ImageLists& lists,
               BlobLayer& layer) {
  const PointSpread widths(show.point_spread, state.projection, exposure_scale(state.settings));
  PerSky<std::optional<StarImages>> makers;
  double many = 0;
  for (const SkyRegion which : kEverySky) {
    if (!plan[which].stars) continue;
    makers[which].emplace(show, state, state.settings.sky[which], optics.table_of(which));
    many +=
        images_expected(makers[which]->count(*skies[which]->stars), plan.gravity, state.projection);
  }
  if (BlobLayer::are_many(many, state.projection)) layer.use_splats(widths);
  for (const SkyRegion which : kEverySky)
    if (makers[which]) add_stars(*makers[which], *skies[which]->stars, widths, lists, layer);
}

}  // namespace domefall
