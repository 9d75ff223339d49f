#include "pipeline/render/scene/sky_store.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "pipeline/sources/sky/sky_file.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {
namespace {

// Returns what is subtracted from a map's light as its black: the level that the show gives, or
// else the map's own dark level.  The microwave background has no such level, since it is a glow of
// its own, whose darkest parts are no floor of a panorama.
DarkLevel black_of(const PanoramaSky& sky, const BackgroundMap& background) {
  const SkyMap& map = *background.map;
  if (sky.black) return {*sky.black / sky.brightness * light_per_luminance(map), *sky.black};
  if (background.is_microwave_background) return {};
  DarkLevel level = dark_level(map);
  level.luminance *= sky.brightness;
  return level;
}

std::optional<SkyBackground> shown_in(const FramePlan::Sky& plan) {
  return plan.background ? std::optional(*plan.shown) : std::nullopt;
}

// Returns the file of a sky that is a map, or an empty path for another sky.
std::filesystem::path map_file_of(const std::optional<SkyBackground>& background) {
  const auto* panorama = background ? std::get_if<PanoramaSky>(&*background) : nullptr;
  return panorama ? panorama->image : std::filesystem::path();
}

bool same_stars(const RegionSky& a, const RegionSky& b) {
  return a.stars && b.stars && a.stars->catalogue == b.stars->catalogue &&
         a.stars->planets_year == b.stars->planets_year;
}

}  // namespace

SkyStore::MagnitudeLimit SkyStore::limit_of(SkyRegion which) const {
  MagnitudeLimit limit{show_.sky[which].stars.value_or(StarField{}).max_magnitude, false};
  for (const Segment& segment : show_.timeline)
    if (const auto& curve = segment.curves[max_magnitude_channel(which)])
      limit = {std::max(limit.faintest, largest(*curve)), true};
  return limit;
}

void SkyStore::load_background(Kept& kept) {
  if (!kept.background) return;
  auto& background = kept.sky.background;
  if (std::holds_alternative<GridSky>(*kept.background)) background = Grid{};
  if (const auto* rings = std::get_if<RingsSky>(&*kept.background)) background = *rings;
  const auto* panorama = std::get_if<PanoramaSky>(&*kept.background);
  if (!panorama) return;
  auto found = maps_.find(panorama->image);
  if (found == maps_.end()) {
    const bool is_made = !is_sky_file(panorama->image);
    if (is_made) make_room();
    found = maps_.emplace(panorama->image, read_sky(panorama->image, detail_.largest_face)).first;
    if (is_made) made_.insert(panorama->image);
  }
  background = found->second.map;
  kept.sky.black = black_of(*panorama, found->second);
}

// Stars that another sky has loaded already are shared.
void SkyStore::load_stars(SkyRegion which, Kept& kept) {
  const RegionSky& own = show_.sky[which];
  if (!own.stars) return;
  const MagnitudeLimit limit = limit_of(which);
  for (const SkyRegion other : kEverySky)
    for (const Kept& loaded : skies_[other])
      if (loaded.has_stars && same_stars(own, show_.sky[other]) && limit == limit_of(other)) {
        kept.sky.stars = loaded.sky.stars;
        return;
      }
  // Where the limit changes, a star that stands for others would come and go with the light of all.
  const std::size_t whole = limit.changes ? kAllWhole : detail_.whole_stars;
  kept.sky.stars = std::make_shared<const SceneStars>(
      read_star_field(*own.stars, limit.faintest, show_.star_epoch, whole).stars);
}

SkyStore::Kept& SkyStore::kept_sky(SkyRegion which,
                                   const std::optional<SkyBackground>& background) {
  auto& skies = skies_[which];
  const auto kept = std::ranges::find(skies, background, &Kept::background);
  return kept != skies.end() ? *kept : skies.emplace_back(Kept{background});
}

bool SkyStore::has_room() const {
  std::size_t sum = 0, largest_map = 0;
  for (const auto& file : made_) {
    const std::size_t bytes = maps_.at(file).map->bytes();
    sum += bytes;
    largest_map = std::max(largest_map, bytes);
  }
  return sum + largest_map <= detail_.most_made_bytes;
}

// The map that was shown longest ago is dropped first.
void SkyStore::make_room() {
  while (!has_room()) {
    // A map that no plan showed counts as one of plan 0.
    std::map<std::filesystem::path, std::uint64_t> last_plan;
    for (const auto& file : made_) last_plan[file] = 0;
    for (const SkyRegion which : kEverySky)
      for (const Kept& kept : skies_[which])
        if (const auto found = last_plan.find(map_file_of(kept.background));
            found != last_plan.end())
          found->second = std::max(found->second, kept.plan);
    const auto oldest = std::ranges::min_element(
        last_plan, {}, &std::pair<const std::filesystem::path, std::uint64_t>::second);
    // Skies that the last two plans were given may still be in use.
    if (oldest->second + 1 >= plans_) return;
    for (const SkyRegion which : kEverySky)
      for (Kept& kept : skies_[which])
        if (map_file_of(kept.background) == oldest->first)
          kept.sky.background = Black{}, kept.has_background = false;
    maps_.erase(oldest->first);
    made_.erase(oldest->first);
  }
}

const Sky& SkyStore::sky(SkyRegion which, const std::optional<SkyBackground>& background,
                         bool stars) {
  const std::scoped_lock lock(loading_);
  Kept& kept = kept_sky(which, background);
  kept.plan = plans_;
  if (!kept.has_background) {
    load_background(kept);
    kept.has_background = true;
  }
  if (stars && !kept.has_stars) {
    load_stars(which, kept);
    kept.has_stars = true;
  }
  return kept.sky;
}

void SkyStore::load(SkyRegion which) {
  sky(which, show_.sky[which].background, true);
  for (const Segment& segment : show_.timeline)
    if (const auto& own = segment.backgrounds[which]) sky(which, own, true);
}

void SkyStore::load(const FramePlan& plan) {
  for (const SkyRegion which : kEverySky) {
    if (!plan[which].lit()) continue;
    const std::optional<SkyBackground> shown = shown_in(plan[which]);
    const auto* panorama = shown ? std::get_if<PanoramaSky>(&*shown) : nullptr;
    // A map for which another one must go is loaded when its frame comes, and not before.
    if (!panorama || maps_.contains(panorama->image) || has_room())
      sky(which, shown, plan[which].stars);
    else if (tried_.insert(panorama->image).second)
      try_sky(panorama->image);
  }
}

PerSky<const Sky*> SkyStore::skies_of(const FramePlan& plan) {
  ++plans_;
  PerSky<const Sky*> skies{};
  for (const SkyRegion which : kEverySky)
    if (plan[which].lit()) skies[which] = &sky(which, shown_in(plan[which]), plan[which].stars);
  return skies;
}

}  // namespace domefall
