#include "pipeline/cli/bodies_at_pixel.h"

#include <algorithm>
#include <cmath>

#include "pipeline/cli/pixel_reach.h"
#include "pipeline/cli/stars_at_pixel.h"
#include "pipeline/render/scene/body_sight.h"

namespace domefall {

std::vector<BodyAtPixel> bodies_at_pixel(const Show& show, const FrameState& state,
                                         PixelPosition pixel) {
  const double reach = pixel_reach(show, state.projection);
  const double sigma = PointSpread(show.point_spread, state.projection, 1).least();
  const V3d towards = direction_at(state.projection, pixel).v;
  const BodySight sight(state, show.effects, show.least_star_radius);
  std::vector<BodyAtPixel> found;
  if (!sight.sees()) return found;
  for (const Body& body : show.bodies) {
    int faint = 0;
    for (int order = sight.first_order(body);
         order < BodySight::kMostOrders && faint < BodySight::kFaintOrders; ++order) {
      const auto image = sight.image(body, order);
      if (!image) break;
      const BodySight::Seen seen = sight.seen(image->at);
      const double magnitude = body.magnitude - 2.5 * std::log10(seen.brightening);
      faint = magnitude > kFaintestSeen ? faint + 1 : 0;
      const auto at = pixel_of(state.projection, seen.direction);
      if (faint > 0 || !at) continue;
      const auto is_near = [&](const SkyImage& piece) {
        return (sight.seen(piece).direction.v - towards).length() <= reach;
      };
      if (is_near(image->at) || std::ranges::any_of(sight.pieces(body, *image, sigma), is_near))
        found.push_back({body.name, image->traced.r, magnitude, seen.frequency_ratio, order, *at});
    }
  }
  std::ranges::stable_sort(found, {}, &BodyAtPixel::seen_v);
  return found;
}

}  // namespace domefall
