#include "pipeline/survey/sky_survey.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "pipeline/sky/maps/sky_file.h"

namespace domefall {
namespace {

// Of the whole sky.
constexpr double kSquareDegrees = 360 * 360 / std::numbers::pi;

SkySources sources_of(SkyRegion region, const RegionSky& sky, double epoch) {
  SkySources found{region, {}, {}, {}};
  if (const auto* panorama = std::get_if<PanoramaSky>(&sky.background)) {
    found.map = panorama->image.filename().string();
    if (is_sky_file(panorama->image))
      found.map_fainter_than = SkyFile(panorama->image).origin().fainter_than;
  }
  if (!sky.stars) return found;
  found.catalogue = sky.stars->catalogue.filename().string();
  const auto stars =
      read_star_catalogue(sky.stars->catalogue, sky.stars->max_magnitude, epoch).stars;
  found.stars = stars.size();
  if (stars.empty()) return found;
  found.faintest = stars.back().v_magnitude;
  if (!found.map_fainter_than) return found;
  for (auto s = stars.rbegin(); s != stars.rend() && s->v_magnitude > *found.map_fainter_than; ++s)
    found.twice += std::pow(10, 0.4 * (10 - double{s->v_magnitude})) / kSquareDegrees;
  return found;
}

bool same(const RegionSky& a, const RegionSky& b) {
  const auto *p = std::get_if<PanoramaSky>(&a.background),
             *q = std::get_if<PanoramaSky>(&b.background);
  const bool same_stars = a.stars.has_value() == b.stars.has_value() &&
                          (!a.stars || (a.stars->catalogue == b.stars->catalogue &&
                                        a.stars->max_magnitude == b.stars->max_magnitude));
  return same_stars && a.background.index() == b.background.index() && (!p || p->image == q->image);
}

}  // namespace

std::vector<SkySources> survey_skies(const Show& show, bool sees_region_three) {
  const RegionSky &one = show.sky[SkyRegion::kI], &three = show.sky[SkyRegion::kIII];
  std::vector<SkySources> found{sources_of(SkyRegion::kI, one, show.star_epoch)};
  if (sees_region_three && !same(one, three))
    found.push_back(sources_of(SkyRegion::kIII, three, show.star_epoch));
  return found;
}

std::string counted_twice_text(const SkySources& s) {
  return fmt::format(
      "the stars of {} from V = {:g} to {:.4g} are seen twice: as stars, and in {}, which holds "
      "the "
      "light of stars fainter than {:g}; give max_magnitude: {:g}, or another map",
      s.catalogue, *s.map_fainter_than, s.faintest, s.map, *s.map_fainter_than,
      *s.map_fainter_than);
}

}  // namespace domefall
