// Lays out the stars of a frame as blobs that are ready to be drawn.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/scene/frame_scene.h"

namespace domefall {

// ImageLists is the memory for the images that one task finds, one list for each thread.
using ImageLists = tbb::enumerable_thread_specific<std::vector<StarImage>>;

// Adds the images of all stars that the frame receives to an empty layer, by all threads of the
// arena that calls.  The layer is the same for any number of threads.
void lay_stars(const FrameScene& scene, ImageLists& lists, BlobLayer& layer);

}  // namespace domefall
