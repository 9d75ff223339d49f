#include "pipeline/render/frame_bodies.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "pipeline/render/body_trail.h"
#include "pipeline/render/stars/star_image_finder.h"

namespace domefall {

namespace {

// A BodyPainter makes images of bodies.
class BodyPainter {
 public:
  BodyPainter(const FrameScene& scene, const DiscPass* disc, const GasRays* gas)
      : scene_(scene), disc_(disc), gas_(gas), trails_(scene), finder_(scene, SkyRegion::kI) {}

  const BodySight& sight() const { return trails_.sight(); }

  // Sets what is drawn of an image, and says whether that is bright enough.
  bool paint(const Body& body, int order, const BodySight::Image& image, BodyImages& drawn) {
    left_.clear(), tints_.clear();
    const SceneStar star = BodySight::star_of(body);
    const std::vector<BodyTrails::Piece> trail = trails_.trail(body, order, image);
    for (const BodyTrails::Piece& piece : trail)
      take(piece.image, piece.psi, piece.tint, piece.solid_angle, drawn);
    if (!trail.empty()) return finder_.append_pieces(star, left_, drawn.light, tints_);
    const std::vector<BodySight::Piece> pieces =
        sight().pieces(body, image, scene_.point_spread.least());
    for (const BodySight::Piece& piece : pieces)
      take(piece.at, image.traced.way(), piece.tint, piece.solid_angle, drawn);
    if (!pieces.empty()) return finder_.append_pieces(star, left_, drawn.light, tints_);
    take(image.at, image.traced.way(), {1, 1, 1}, 0, drawn);
    return !left_.empty() && finder_.append_image(star, left_[0], drawn.light);
  }

  // Likewise of all images together, where they are a trail.
  bool paint_all(const Body& body, BodyImages& drawn) {
    left_.clear(), tints_.clear();
    const std::vector<BodyTrails::Piece> trail = trails_.listed_trail(body);
    for (const BodyTrails::Piece& piece : trail)
      take(piece.image, piece.psi, piece.tint, piece.solid_angle, drawn);
    if (!left_.empty()) finder_.append_pieces(BodySight::star_of(body), left_, drawn.light, tints_);
    return !trail.empty();
  }

 private:
  // The disc hides each piece by itself, since the edge of its image may cross that of the body.
  void take(SkyImage piece, double psi, const WorkingRgb& tint, double solid_angle,
            BodyImages& drawn) {
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
      drawn.cover.push_back({static_cast<float>(pixel->i - 1),
                             static_cast<float>(pixel->j - 1),
                             {covers, covers, covers}});
      // Gas in front of the sphere is hidden with what is behind it, and so added again.
      const std::array<float, 3> light = front.even_light();
      const auto again = covers * static_cast<float>(scene_.exposure);
      if (light[0] + light[1] + light[2] > 0)
        drawn.light.push_back({drawn.cover.back().x,
                               drawn.cover.back().y,
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
  std::vector<SkyImage> left_;
  std::vector<WorkingRgb> tints_;
};

}  // namespace

std::vector<BodyImages> images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                                         const DiscPass* disc, const GasRays* gas) {
  std::vector<BodyImages> images;
  if (bodies.empty()) return images;
  BodyPainter painter(scene, disc, gas);
  const BodySight& sight = painter.sight();
  if (!sight.sees()) return images;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Body& body = bodies[k];
    const bool together = sight.lists_images() && sight.first_order(body) == 0;
    if (const auto nearest = together ? sight.image(body, 0) : std::nullopt) {
      BodyImages drawn{k, sight.far(body, nearest->traced), {}, {}};
      if (painter.paint_all(body, drawn)) {
        images.push_back(std::move(drawn));
        continue;
      }
    }
    // Higher orders become ever fainter, so the search ends after a few faint ones in succession.
    int faint = 0;
    for (int order = sight.first_order(body);
         order < BodySight::kMostOrders && faint < BodySight::kFaintOrders; ++order) {
      const auto image = sight.image(body, order);
      if (!image) break;
      BodyImages drawn{k, sight.far(body, image->traced), {}, {}};
      faint = painter.paint(body, order, *image, drawn) ? 0 : faint + 1;
      images.push_back(std::move(drawn));
    }
  }
  std::ranges::stable_sort(images, std::greater<>(), &BodyImages::far);
  return images;
}

std::vector<BodyLayer> lay_bodies(const FrameScene& scene, std::span<const BodyImages> images,
                                  std::optional<std::size_t> only) {
  const auto laid = [&](const std::vector<StarImage>& of) {
    BlobLayer layer(scene.projection());
    layer.add(of, scene.point_spread);
    layer.sort_into_bands();
    return layer;
  };
  std::vector<BodyLayer> layers;
  for (std::size_t k = 0; k < images.size();) {
    std::optional<BlobLayer> cover;
    if (!images[k].cover.empty()) cover = laid(images[k].cover);
    // What covers nothing is drawn together with what it is before.
    std::vector<StarImage> light;
    do {
      if (!only || images[k].body == *only)
        light.insert(light.end(), images[k].light.begin(), images[k].light.end());
      ++k;
    } while (k < images.size() && images[k].cover.empty());
    layers.push_back({std::move(cover), laid(light)});
  }
  return layers;
}

bool any_covers(std::span<const BodyLayer> layers) {
  return std::ranges::any_of(layers,
                             [](const BodyLayer& layer) { return layer.cover.has_value(); });
}

void draw_bodies(std::span<const BodyLayer> layers, int band, std::size_t pixels,
                 SplatBuffer& splats, float* rgb, float* left) {
  // A whole pixel that is covered by pieces, which ripple by some 5e-4, is covered as a whole.
  constexpr float kWhole = 1 - 1e-3f;
  std::vector<float> covered;
  for (const BodyLayer& layer : layers) {
    if (layer.cover && layer.cover->reaches(band)) {
      covered.assign(3 * pixels, 0);
      layer.cover->draw_band(band, splats, covered.data());
      for (std::size_t k = 0; k < pixels; ++k) {
        if (!(covered[3 * k] > 0)) continue;
        const float passes = 1 - std::min(covered[3 * k] / kWhole, 1.0f);
        for (std::size_t c = 3 * k; c < 3 * k + 3; ++c) rgb[c] *= passes;
        if (left) left[k] *= passes;
      }
    }
    layer.light.draw_band(band, splats, rgb);
  }
}

}  // namespace domefall
