#include "pipeline/cli/stars_at_pixel.h"

#include <algorithm>
#include <cmath>

#include "pipeline/cli/pixel_reach.h"
#include "pipeline/render/scene/star_light.h"
#include "pipeline/render/scene/star_sight.h"
#include "pipeline/show/stars_section.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

std::vector<std::string> names_of_star(const StarCatalogue& catalogue, const Star& star) {
  std::vector<std::string> names;
  for (const NamedStar& name : catalogue.names)
    if (name.direction.v == star.direction.v) names.push_back(name.name);
  return names;
}

}  // namespace

std::vector<StarAtPixel> stars_at_pixel(const Show& show, const FrameState& state,
                                        PixelPosition pixel) {
  const double reach = pixel_reach(show, state.projection);
  const V3d towards = direction_at(state.projection, pixel).v;
  const StarSight sight(state, show.effects);
  std::vector<StarAtPixel> found;
  for (const SkyRegion sky : kExteriorSkies) {
    const auto& field = show.sky[sky].stars;
    if (!field || !sight.sees(sky)) continue;
    const FrameSettings::Sky& settings = state.settings.sky[sky];
    const double gain = settings.star_gain / default_star_gain(show.point_spread);
    const StarCatalogue catalogue =
        read_star_catalogue(field->catalogue, settings.max_magnitude, show.star_epoch);
    for (const Star& star : catalogue.stars) {
      const double v = star.v_magnitude, drawn = gain * part_within_limit(settings, v);
      if (!(drawn > 0)) break;  // those that follow are fainter
      int faint = 0;            // images in succession
      for (int order = 0; order < sight.orders(); ++order) {
        const StarSight::Image image = sight.image(sky, star.direction, order);
        const double seen = v - 2.5 * std::log10(drawn * image.brightening);
        // The images of a pair of orders lie on opposite sides of the hole, where motion may dim
        // one of them alone.  If both are too faint, so are all that follow.
        faint = seen <= kFaintestSeen ? 0 : faint + 1;
        if (faint == 2) break;
        if (faint > 0) continue;
        if ((image.direction.v - towards).length() > reach) continue;
        const auto at = pixel_of(state.projection, image.direction);
        if (!at) continue;
        const Equatorial place = equatorial(star.direction);
        found.push_back({names_of_star(catalogue, star), sky, place.ra_deg, place.dec_deg, v, seen,
                         order, *at});
      }
    }
  }
  std::ranges::stable_sort(found, {}, &StarAtPixel::seen_v);
  return found;
}

}  // namespace domefall
