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
Sky Scene::load(SeenSky which) const {
  const RegionSky& own = region(which);
  Sky sky;
  if (std::holds_alternative<GridSky>(own.background)) sky.background = Grid{};
  if (const auto* rings = std::get_if<RingsSky>(&own.background)) sky.background = *rings;
  for (const SeenSky other : kEverySky) {
    const auto& loaded = skies_[static_cast<std::size_t>(other)];
    if (!loaded) continue;
    if (same_background(own, region(other))) sky.background = loaded->background;
    if (same_stars(own, region(other)) && limit_of(which) == limit_of(other))
      sky.stars = loaded->stars;
  }
  const auto* panorama = std::get_if<PanoramaSky>(&own.background);
  if (panorama && std::holds_alternative<Black>(sky.background))
    sky.background = read_sky(panorama->image);
  if (sky.stars) return sky;
  sky.stars =
      own.stars
          ? std::make_shared<const SceneStars>(
                read_star_catalogue(own.stars->catalogue, limit_of(which), show_.star_epoch).stars)
          : std::make_shared<const SceneStars>();
  return sky;
}

const Sky& Scene::sky(SeenSky which) {
  const std::scoped_lock lock(loading_);
  auto& kept = skies_[static_cast<std::size_t>(which)];
  if (!kept) kept = std::make_unique<Sky>(load(which));
  return *kept;
}

}  // namespace domefall
