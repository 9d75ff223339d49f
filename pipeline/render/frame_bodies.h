// Lays out the bodies of a frame as blobs that are ready to be drawn.
#pragma once

#include <span>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// Adds those images of the bodies that are bright enough to an empty layer.  Each is dimmed by the
// parts of the disc that its light has crossed.  `disc` is null where there is none.
void lay_bodies(std::span<const Body> bodies, const FrameScene& scene, const DiscPass* disc,
                BlobLayer& layer);

}  // namespace domefall
