#include "pipeline/render/frame_bodies.h"

#include <utility>
#include <vector>

#include "pipeline/render/body_trail.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {

namespace {

// Appends one image, and says whether it is bright enough.
bool append_body(BodyTrails& trails, const Body& body, int order, const BodySight::Image& image,
                 const DiscPass* disc, const FrameScene& scene, const StarImageFinder& finder,
                 std::vector<StarImage>& images) {
  const SceneStar star = BodySight::star_of(body);
  // The disc hides each piece by itself, since the edge of its image may cross that of the body.
  const auto before_disc = [&](SkyImage piece, double psi) {
    if (disc)
      piece.amplification *= disc->left_before(trails.sight().seen(piece).direction, psi,
                                               largest_pixel_angle(scene.projection()));
    return piece;
  };
  std::vector<SkyImage> left;
  std::vector<WorkingRgb> tints;
  for (const BodyTrails::Piece& piece : trails.trail(body, order, image)) {
    left.push_back(before_disc(piece.image, piece.psi));
    tints.push_back(piece.tint);
  }
  if (!left.empty()) return finder.append_trail(star, left, images, tints);
  for (const BodySight::Piece& piece :
       trails.sight().pieces(body, image, scene.point_spread.least())) {
    left.push_back(before_disc(piece.at, image.traced.psi));
    tints.push_back(piece.tint);
  }
  return left.empty() ? finder.append_image(star, before_disc(image.at, image.traced.psi), images)
                      : finder.append_pieces(star, left, images, tints);
}

}  // namespace

std::vector<StarImage> images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                                        const DiscPass* disc) {
  BodyTrails trails(scene);
  const BodySight& sight = trails.sight();
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
        const bool bright = append_body(trails, body, order, *image, disc, scene, finder, images);
        faint = bright ? 0 : faint + 1;
      }
    }
  }
  return images;
}

// An observer who sees no bodies gets an empty layer, which draws nothing.
BlobLayer lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc) {
  BlobLayer layer(scene.projection());
  layer.add(images_of_bodies(scene, bodies, disc), scene.point_spread);
  layer.sort_into_bands();
  return layer;
}

}  // namespace domefall
