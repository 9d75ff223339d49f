// Lays out the bodies of a frame as blobs that are ready to be drawn.
#pragma once

#include <optional>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// Returns a layer with those images of the scene's bodies that are bright enough, or nothing where
// the scene has no bodies.  Each image is dimmed by the parts of the disc that its light has
// crossed.  `disc` is null where there is none.
std::optional<BlobLayer> lay_bodies(const FrameScene& scene, const DiscPass* disc);

}  // namespace domefall
