// Lays out the bodies of a frame as blobs that are ready to be drawn.
#pragma once

#include <span>
#include <vector>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/scene/star_image.h"

namespace domefall {

// Returns the images of bodies of the scene that are bright enough.  Some may lie outside the frame.
// Each image is dimmed by the parts of the disc that its light has crossed.  `disc` is null where
// there is none.  Images that move are trails (body_trail.h).
std::vector<StarImage> images_of_bodies(const FrameScene& scene, std::span<const Body> bodies,
                                        const DiscPass* disc);

// Returns a layer with these images.
BlobLayer lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc);

}  // namespace domefall
