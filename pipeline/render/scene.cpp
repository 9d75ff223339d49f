#include "pipeline/render/scene.h"

#include <algorithm>

#include "pipeline/sky/read_sky.h"
#include "pipeline/sky/star_catalogue.h"

namespace domefall {
namespace {

bool same_background(const RegionSky& a, const RegionSky& b) {
  const auto *p = std::get_if<PanoramaSky>(&a.background),
             *q = std::get_if<PanoramaSky>(&b.background);
  return p && q && p->image == q->image;
}

bool same_stars(const RegionSky& a, const RegionSky& b) {
  return a.stars && b.stars && a.stars->catalogue == b.stars->catalogue;
}

// The faintest stars of a sky that any frame takes.
double deepest_magnitude(const Show& show, SeenSky which, double constant) {
  const auto channel = static_cast<std::size_t>(which == SeenSky::kOne ? Channel::kMagnitudeOne
                                                                       : Channel::kMagnitudeThree);
  double deepest = constant;
  for (const Segment& segment : show.timeline)
    if (const auto& curve = segment.curves[channel]) deepest = std::max(deepest, largest(*curve));
  return deepest;
}

}  // namespace

const RegionSky& Scene::region(SeenSky which) const {
  if (which == SeenSky::kOne) return show_.sky_one;
  return which == SeenSky::kThree ? show_.sky_three : show_.sky_four;
}

double Scene::limit_of(SeenSky which) const {
  return deepest_magnitude(show_, which, region(which).stars.value_or(StarField{}).max_magnitude);
}

// What another sky has loaded already is shared with it.
void Scene::load_background(SeenSky which) {
  const RegionSky& own = region(which);
  auto& background = skies_[static_cast<std::size_t>(which)].sky.background;
  if (std::holds_alternative<GridSky>(own.background)) background = Grid{};
  if (const auto* rings = std::get_if<RingsSky>(&own.background)) background = *rings;
  const auto* panorama = std::get_if<PanoramaSky>(&own.background);
  if (!panorama) return;
  for (const SeenSky other : kEverySky) {
    const Loaded& loaded = skies_[static_cast<std::size_t>(other)];
    if (!loaded.background || !same_background(own, region(other))) continue;
    background = loaded.sky.background;
    return;
  }
  background = read_sky(panorama->image);
}

void Scene::load_stars(SeenSky which) {
  const RegionSky& own = region(which);
  if (!own.stars) return;
  auto& stars = skies_[static_cast<std::size_t>(which)].sky.stars;
  for (const SeenSky other : kEverySky) {
    const Loaded& loaded = skies_[static_cast<std::size_t>(other)];
    if (!loaded.stars || !same_stars(own, region(other)) || limit_of(which) != limit_of(other))
      continue;
    stars = loaded.sky.stars;
    return;
  }
  stars = std::make_shared<const SceneStars>(
      read_star_catalogue(own.stars->catalogue, limit_of(which), show_.star_epoch).stars);
}

const Sky& Scene::sky(SeenSky which, bool background, bool stars) {
  const std::scoped_lock lock(loading_);
  Loaded& kept = skies_[static_cast<std::size_t>(which)];
  if (background && !kept.background) load_background(which), kept.background = true;
  if (stars && !kept.stars) load_stars(which), kept.stars = true;
  return kept.sky;
}

}  // namespace domefall
