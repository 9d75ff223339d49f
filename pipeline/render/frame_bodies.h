// Lays out the bodies of a frame as blobs that are ready to be drawn.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/scene/star_image.h"

namespace domefall {

// A BodyImages is one image of a body, as blobs that are bright enough, and what its sphere covers of
// the pixels, as light whose value is 1 where a pixel is covered as a whole.  Some may lie outside the
// frame.
struct BodyImages {
  std::size_t body;  // its place in the list
  double far;        // BodySight::far
  std::vector<StarImage> light, cover;
};
// Returns the images from the farthest one on.  Each is dimmed by the parts of the disc that its light
// has crossed.  `disc` and `gas` are null where there is none.  Images that move are trails
// (body_trail.h).
std::vector<BodyImages> images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                                         const DiscPass* disc, const GasRays* gas = nullptr);

// A BodyLayer hides what is behind a sphere, and has the light of that and of points before it.
struct BodyLayer {
  std::optional<BlobLayer> cover;  // where a sphere covers anything
  BlobLayer light;
};
// Returns layers with these images, which are drawn one after the other, and perhaps with the light of
// one body only.
std::vector<BodyLayer> lay_bodies(const FrameScene& scene, std::span<const BodyImages> images,
                                  std::optional<std::size_t> only = {});

bool any_covers(std::span<const BodyLayer> layers);
// Draws layers over the pixels of a band.  Where `left` is not null, each of its values is multiplied by
// what spheres leave of the light behind them.
void draw_bodies(std::span<const BodyLayer> layers, int band, std::size_t pixels,
                 SplatBuffer& splats, float* rgb, float* left);

}  // namespace domefall
