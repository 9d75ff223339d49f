// The bodies of a frame, laid out as blobs that are ready to be drawn.
#pragma once

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// Adds all images of the show's bodies that are bright enough to an empty layer.
void lay_bodies(const Show& show, const FrameScene& scene, BlobLayer& layer);

}  // namespace domefall
