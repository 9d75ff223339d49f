#include "pipeline/render/frame_bodies.h"

#include <vector>

#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {

void lay_bodies(const Show& show, const FrameScene& scene, const DiscPass* disc, BlobLayer& layer) {
  const BodySight sight(show, scene.state);
  std::vector<StarImage> images;
  if (sight.sees()) {
    const StarImageFinder finder(scene, SkyRegion::kI);
    for (const Body& body : show.bodies) {
      const SceneStar star = BodySight::star_of(body);
      int faint = 0;
      for (int order = 0; order < BodySight::kMostOrders && faint < BodySight::kFaintOrders;
           ++order) {
        auto image = sight.image(body, order);
        if (!image) break;
        if (disc)
          image->at.amplification *= disc->left_before(sight.seen(image->at).direction, image->psi);
        faint = finder.append_image(star, image->at, images) ? 0 : faint + 1;
      }
    }
  }
  layer.add(images, scene.point_spread);
  layer.sort_into_bands();
}

}  // namespace domefall
