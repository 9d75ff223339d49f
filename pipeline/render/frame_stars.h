// The stars of a frame: found and laid out, ready to be drawn.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/sky/pixel_shader.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Memory for a task's images, one for each thread.
using ImageLists = tbb::enumerable_thread_specific<std::vector<StarImage>>;

// Adds what the frame receives of the skies' stars to an empty layer, by all threads of the arena that
// calls: the same layer for any number of them.  skies: those of the plan with stars have some.
void lay_stars(const Show& show, const FrameState& state, const FramePlan& plan,
               const HoleOptics& optics, const PixelShader::Skies& skies, ImageLists& lists,
               BlobLayer& layer);

}  // namespace domefall
