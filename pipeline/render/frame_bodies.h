// Lays out the bodies of a frame as blobs that are ready to be drawn.
#pragma once

#include <span>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// Returns a layer with those images of bodies of the scene that are bright enough.  Each image is
// dimmed by the parts of the disc that its light has crossed.  `disc` is null where there is none.
BlobLayer lay_bodies(const FrameScene& scene, std::span<const Body> bodies, const DiscPass* disc);

}  // namespace domefall
