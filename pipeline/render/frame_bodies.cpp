#include "pipeline/render/frame_bodies.h"

#include <utility>
#include <vector>

#include "pipeline/render/body_trail.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {

namespace {

// A BodyPainter appends images of bodies, and what they cover.
class BodyPainter {
 public:
  BodyPainter(const FrameScene& scene, const DiscPass* disc, const GasRays* gas, BodyImages& images)
      : scene_(scene),
        disc_(disc),
        gas_(gas),
        trails_(scene),
        finder_(scene, SkyRegion::kI),
        images_(images) {}

  const BodySight& sight() const { return trails_.sight(); }

  // Appends one image, and says whether it is bright enough.
  bool append(const Body& body, int order, const BodySight::Image& image) {
    left_.clear(), tints_.clear();
    const SceneStar star = BodySight::star_of(body);
    const std::vector<BodyTrails::Piece> trail = trails_.trail(body, order, image);
    for (const BodyTrails::Piece& piece : trail)
      take(piece.image, piece.psi, piece.tint, piece.solid_angle);
    if (!trail.empty()) return finder_.append_trail(star, left_, images_.light, tints_);
    const std::vector<BodySight::Piece> pieces =
        sight().pieces(body, image, scene_.point_spread.least());
    for (const BodySight::Piece& piece : pieces)
      take(piece.at, image.traced.way(), piece.tint, piece.solid_angle);
    if (!pieces.empty()) return finder_.append_pieces(star, left_, images_.light, tints_);
    take(image.at, image.traced.way(), {1, 1, 1}, 0);
    return !left_.empty() && finder_.append_image(star, left_[0], images_.light);
  }

 private:
  // The disc hides each piece by itself, since the edge of its image may cross that of the body.
  void take(SkyImage piece, double psi, const WorkingRgb& tint, double solid_angle) {
    const BodySight::Seen seen = sight().seen(piece);
    GasSight front;
    if (gas_ && (disc_ || solid_angle > 0)) front = gas_->sight_before(seen.direction, psi);
    const double left =
        gas_    ? static_cast<double>(front.left)
        : disc_ ? disc_->left_before(seen.direction, psi, largest_pixel_angle(scene_.projection()))
                : 1;
    // The light of a pixel that is wholly covered is 1.
    const auto pixel =
        solid_angle * left > 0 ? pixel_of(scene_.projection(), seen.direction) : std::nullopt;
    if (pixel) {
      const auto covers = static_cast<float>(left * solid_angle / (seen.doppler * seen.doppler));
      images_.cover.push_back({static_cast<float>(pixel->i - 1),
                               static_cast<float>(pixel->j - 1),
                               {covers, covers, covers}});
      // Gas in front of the sphere is hidden with what is behind it, and so added again.
      const std::array<float, 3> light = front.even_light();
      const auto again = covers * static_cast<float>(scene_.exposure);
      if (light[0] + light[1] + light[2] > 0)
        images_.light.push_back({images_.cover.back().x,
                                 images_.cover.back().y,
                                 {again * light[0], again * light[1], again * light[2]}});
    }
    piece.amplification *= left;
    if (!(piece.amplification > 0)) return;
    left_.push_back(piece), tints_.push_back(tint);
  }

  const FrameScene& scene_;
  const DiscPass* disc_;
  const GasRays* gas_;
  BodyTrails trails_;
  const StarImageFinder finder_;  // bodies are in region I or have come from there
  BodyImages& images_;
  std::vector<SkyImage> left_;
  std::vector<WorkingRgb> tints_;
};

}  // namespace

BodyImages images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                            const DiscPass* disc, const GasRays* gas) {
  BodyImages images;
  BodyPainter painter(scene, disc, gas, images);
  const BodySight& sight = painter.sight();
  if (!sight.sees()) return images;
  for (const Body& body : bodies) {
    // Higher orders become ever fainter, so the search ends after a few faint ones in succession.
    int faint = 0;
    for (int order = sight.first_order(body);
         order < BodySight::kMostOrders && faint < BodySight::kFaintOrders; ++order) {
      const auto image = sight.image(body, order);
      if (!image) break;
      faint = painter.append(body, order, *image) ? 0 : faint + 1;
    }
  }
  return images;
}

// An observer who sees no bodies gets an empty layer, which draws nothing.
BodyLayers lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc,
                      const GasRays* gas) {
  const BodyImages images = images_of_bodies(scene, bodies, disc, gas);
  const auto layer = [&](const std::vector<StarImage>& of) {
    BlobLayer laid(scene.projection());
    laid.add(of, scene.point_spread);
    laid.sort_into_bands();
    return laid;
  };
  BodyLayers layers{layer(images.light), std::nullopt};
  if (!images.cover.empty()) layers.cover.emplace(layer(images.cover));
  return layers;
}

}  // namespace domefall
