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

// BodyImages are images of bodies that are bright enough, and what their spheres cover of the pixels,
// as light whose value is 1 where a pixel is covered as a whole.  Some may lie outside the frame.
struct BodyImages {
  std::vector<StarImage> light, cover;
};
// Each image is dimmed by the parts of the disc that its light has crossed.  `disc` and `gas` are null where
// there is none.  Images that move are trails (body_trail.h).
BodyImages images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                            const DiscPass* disc, const GasRays* gas = nullptr);

// Returns layers with these images.
struct BodyLayers {
  BlobLayer light;
  std::optional<BlobLayer> cover;  // where a sphere covers anything
};
BodyLayers lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc,
                      const GasRays* gas = nullptr);

}  // namespace domefall
