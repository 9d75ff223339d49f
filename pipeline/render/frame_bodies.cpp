#include "pipeline/render/frame_bodies.h"

#include <utility>
#include <vector>

#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {

namespace {

// Appends one image, and says whether it is bright enough.
bool append_body(const BodySight& sight, const Body& body, const BodySight::Image& image,
                 const DiscPass* disc, const FrameScene& scene, const StarImageFinder& finder,
                 std::vector<StarImage>& images) {
  const SceneStar star = BodySight::star_of(body);
  std::vector<SkyImage> pieces = sight.pieces(body, image, scene.point_spread.least());
  const bool is_one = pieces.empty();
  if (is_one) pieces.push_back(image.at);
  // The disc hides each piece by itself, since the edge of its image may cross that of the body.
  if (disc)
    for (SkyImage& piece : pieces)
      piece.amplification *= disc->left_before(sight.seen(piece).direction, image.traced.psi,
                                               largest_pixel_angle(scene.projection()));
  return is_one ? finder.append_image(star, pieces[0], images)
                : finder.append_pieces(star, pieces, images);
}

}  // namespace

BlobLayer lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc) {
  const BodySight sight(scene.state, scene.effects, scene.least_star_radius);
  std::vector<StarImage> images;
  if (sight.sees()) {
    // Bodies are in region I or have come from there.
    const StarImageFinder finder(scene, SkyRegion::kI);
    for (const Body& body : bodies) {
      // Higher orders become ever fainter, so the search ends after a few faint ones in succession.
      int faint = 0;
      for (int order = sight.first_order(body);
           order < BodySight::kMostOrders && faint < BodySight::kFaintOrders; ++order) {
        const auto image = sight.image(body, order);
        if (!image) break;
        const bool bright = append_body(sight, body, *image, disc, scene, finder, images);
        faint = bright ? 0 : faint + 1;
      }
    }
  }
  // An observer who sees no bodies gets an empty layer, which draws nothing.
  BlobLayer layer(scene.projection());
  layer.add(images, scene.point_spread);
  layer.sort_into_bands();
  return layer;
}

}  // namespace domefall
