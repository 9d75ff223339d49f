#include "pipeline/render/scene/sky_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/read_sky.h"

namespace domefall {
namespace {

// The microwave background is a glow of its own, whose darkest parts are no floor of a picture.
DarkLevel black_of(const PanoramaSky& sky, const SkyMap& map) {
  if (sky.black) return {light_of_luminance(map, *sky.black / sky.brightness), *sky.black};
  if (is_microwave_background(sky.image)) return {};
  DarkLevel level = dark_level(map);
  level.luminance *= sky.brightness;
  return level;
}

bool same_stars(const RegionSky& a, const RegionSky& b) {
  return a.stars && b.stars && a.stars->catalogue == b.stars->catalogue;
}

}  // namespace

bool SkyStore::limit_changes(SkyRegion which) const {
  return std::any_of(show_.timeline.begin(), show_.timeline.end(), [which](const Segment& segment) {
    return segment.curves[max_magnitude_channel(which)].has_value();
  });
}

double SkyStore::faintest_magnitude(SkyRegion which) const {
  double faintest = show_.sky[which].stars.value_or(StarField{}).max_magnitude;
  for (const Segment& segment : show_.timeline)
    if (const auto& curve = segment.curves[max_magnitude_channel(which)])
      faintest = std::max(faintest, largest(*curve));
  return faintest;
}

void SkyStore::load_background(Kept& kept) {
  if (!kept.background) return;
  auto& background = kept.sky.background;
  if (std::holds_alternative<GridSky>(*kept.background)) background = Grid{};
  if (const auto* rings = std::get_if<RingsSky>(&*kept.background)) background = *rings;
  const auto* panorama = std::get_if<PanoramaSky>(&*kept.background);
  if (!panorama) return;
  auto& map = maps_[panorama->image];
  if (!map) map = read_sky(panorama->image, detail_.largest_face);
  background = map;
  kept.sky.black = black_of(*panorama, *map);
}

// Stars that another sky has loaded already are shared with it.
void SkyStore::load_stars(SkyRegion which, Kept& kept) {
  const RegionSky& own = show_.sky[which];
  if (!own.stars) return;
  const double faintest = faintest_magnitude(which);
  for (const SkyRegion other : kEverySky)
    for (const Kept& loaded : skies_[other])
      if (loaded.has_stars && same_stars(own, show_.sky[other]) &&
          faintest == faintest_magnitude(other)) {
        kept.sky.stars = loaded.sky.stars;
        return;
      }
  StarCatalogue catalogue = read_star_catalogue(own.stars->catalogue, faintest, show_.star_epoch);
  if (detail_.whole_stars > 0 && !limit_changes(which))
    catalogue.stars = thinned(catalogue.stars, detail_.whole_stars);
  kept.sky.stars = std::make_shared<const SceneStars>(catalogue.stars);
}

const Sky& SkyStore::sky(SkyRegion which, const std::optional<SkyBackground>& background,
                         bool stars) {
  const std::scoped_lock lock(loading_);
  auto& skies = skies_[which];
  auto kept = std::ranges::find(skies, background, &Kept::background);
  if (kept == skies.end()) {
    Kept added{background};
    load_background(added);
    skies.push_back(std::move(added));
    kept = std::prev(skies.end());
  }
  if (stars && !kept->has_stars) {
    load_stars(which, *kept);
    kept->has_stars = true;
  }
  return kept->sky;
}

void SkyStore::load(SkyRegion which) {
  sky(which, show_.sky[which].background, true);
  for (const Segment& segment : show_.timeline)
    if (const auto& own = segment.backgrounds[which]) sky(which, own, true);
}

PerSky<const Sky*> SkyStore::skies_of(const FramePlan& plan) {
  PerSky<const Sky*> skies{};
  for (const SkyRegion which : kEverySky)
    if (plan[which].lit())
      skies[which] =
          &sky(which, plan[which].background ? std::optional(*plan[which].shown) : std::nullopt,
               plan[which].stars);
  return skies;
}

}  // namespace domefall
