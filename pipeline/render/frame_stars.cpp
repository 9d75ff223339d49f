#include "pipeline/render/frame_stars.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {
namespace {

// Returns the number of stars whose images one task finds.  It does not depend on the number of
// threads, and grows where there are many stars.
std::size_t stars_per_task(std::size_t count) {
  constexpr std::size_t kLeast = 16 * kStarBatch, kTasks = 64;
  return std::max(kLeast, count / kTasks / kStarBatch * kStarBatch);
}

// Adds the images of one sky's stars.  Each task has a place of its own in the layer, in the order
// of the catalogue, so that the layer holds the same images in the same order for any number of
// threads.
void add_stars(const StarImageFinder& maker, const SceneStars& stars,
               const PointSpread& point_spread, ImageLists& lists, BlobLayer& layer) {
  const std::size_t count = maker.count(stars);
  // The last task may have fewer stars than the others.
  const std::size_t each = stars_per_task(count), tasks = (count + each - 1) / each;
  const std::size_t before = layer.new_tasks(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    const std::size_t first = task * each, end = std::min(count, first + each);
    std::vector<StarImage>& images = lists.local();
    images.clear();
    for (std::size_t k = first; k < end; k += kStarBatch) maker.append(stars, k, end, images);
    layer.place(before + task, images, point_spread);
  });
}

// Estimates the number of images from the part of the sphere that the frame shows.  For an observer
// falling at 7 M a dome shows two images of each star on average, which makes 4 for the whole
// sphere.
double images_expected(std::size_t stars, const FrameScene& scene) {
  const Projection& p = scene.projection();
  const double pixel = largest_pixel_angle(p);
  const double part =
      traits_of(p).half_sphere
          ? 0.5
          : std::min(1.0, pixel * pixel * columns(p) * rows(p) / (4 * std::numbers::pi));
  // In flat space each star has one image.
  return static_cast<double>(stars) * part * (scene.plan.gravity ? 4 : 1);
}

}  // namespace

void lay_stars(const FrameScene& scene, ImageLists& lists, BlobLayer& layer) {
  PerSky<std::optional<StarImageFinder>> makers;
  double expected = 0;
  for (const SkyRegion sky : kEverySky) {
    if (scene.stars[sky] == nullptr) continue;
    makers[sky].emplace(scene, sky);
    expected += images_expected(makers[sky]->count(*scene.stars[sky]), scene);
  }
  // Splats are quicker than ellipses only where images are many, and all skies share the layer.
  if (BlobLayer::are_many(expected, scene.projection())) layer.use_splats(scene.point_spread);
  for (const SkyRegion sky : kEverySky)
    if (makers[sky]) add_stars(*makers[sky], *scene.stars[sky], scene.point_spread, lists, layer);
}

}  // namespace domefall
