// Draws the pixels of a frame in bands of rows.  Each band is shaded, covered with stars and stored
// while it is in the cache of one thread.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <optional>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/rays/sky_borders.h"
#include "pipeline/render/sky/sky_pass.h"

namespace domefall {

// Rendering throws RenderStopped when it was told to stop.
struct RenderStopped {};

// BandMemory is the memory of each thread.  It is kept from frame to frame, since getting new
// memory takes more time than writing into it.
struct BandMemory {
  tbb::enumerable_thread_specific<SplatBuffer> splats{};
  tbb::enumerable_thread_specific<std::vector<float>> rows{}, background{};
  const std::atomic<bool>* stop = nullptr;  // set to end the frame early; or null

  void throw_if_stopped() const {
    if (stop && *stop) throw RenderStopped{};
  }
};

// Draws skies and stars, the disc in front of them, and bodies into a frame of the projection's
// size, by all threads of the arena that calls.  The disc and the bodies may be null.  If borders
// are given, stars end at them, but bodies do not.  In a half frame, a value beyond the largest
// half (65504) is stored as the largest.  T is Imath::half or float.  Throws std::runtime_error,
// naming the pixel, if a value is not finite, and RenderStopped once `stop` is set.
template <class T>
void draw_bands(const FrameScene& scene, const SkyPass& sky, const BlobLayer& stars,
                const DiscPass* disc, const std::optional<SkyBorders>& borders,
                const BlobLayer* bodies, BandMemory& memory, ImageRgb<T>& frame);

}  // namespace domefall
