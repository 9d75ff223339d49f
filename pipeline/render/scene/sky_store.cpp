#include "pipeline/render/scene/sky_store.h"

#include <algorithm>

#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/read_sky.h"

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

}  // namespace

double SkyStore::faintest_magnitude(SkyRegion which) const {
  double faintest = show_.sky[which].stars.value_or(StarField{}).max_magnitude;
  for (const Segment& segment : show_.timeline)
    if (const auto& curve = segment.curves[max_magnitude_channel(which)])
      faintest = std::max(faintest, largest(*curve));
  return faintest;
}

// A map that another sky has loaded already is shared with it, and so are stars.
void SkyStore::load_background(SkyRegion which) {
  const RegionSky& own = show_.sky[which];
  auto& background = skies_[which].sky.background;
  if (std::holds_alternative<GridSky>(own.background)) background = Grid{};
  if (const auto* rings = std::get_if<RingsSky>(&own.background)) background = *rings;
  const auto* panorama = std::get_if<PanoramaSky>(&own.background);
  if (!panorama) return;
  for (const SkyRegion other : kEverySky) {
    const Loaded& loaded = skies_[other];
    if (!loaded.background || !same_background(own, show_.sky[other])) continue;
    background = loaded.sky.background;
    return;
  }
  background = read_sky(panorama->image, largest_face_);
}

void SkyStore::load_stars(SkyRegion which) {
  const RegionSky& own = show_.sky[which];
  if (!own.stars) return;
  const double faintest = faintest_magnitude(which);
  auto& stars = skies_[which].sky.stars;
  for (const SkyRegion other : kEverySky) {
    const Loaded& loaded = skies_[other];
    if (!loaded.stars || !same_stars(own, show_.sky[other]) ||
        faintest != faintest_magnitude(other))
      continue;
    stars = loaded.sky.stars;
    return;
  }
  stars = std::make_shared<const SceneStars>(
      read_star_catalogue(own.stars->catalogue, faintest, show_.star_epoch).stars);
}

const Sky& SkyStore::sky(SkyRegion which, bool background, bool stars) {
  const std::scoped_lock lock(loading_);
  Loaded& kept = skies_[which];
  if (background && !kept.background) {
    load_background(which);
    kept.background = true;
  }
  if (stars && !kept.stars) {
    load_stars(which);
    kept.stars = true;
  }
  return kept.sky;
}

PerSky<const Sky*> SkyStore::skies_of(const FramePlan& plan) {
  PerSky<const Sky*> skies{};
  for (const SkyRegion which : kEverySky)
    if (plan[which].lit()) skies[which] = &sky(which, plan[which].background, plan[which].stars);
  return skies;
}

}  // namespace domefall
