// The pixels of a frame, in bands of rows.  Each band is shaded, covered with stars and stored
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

// What rendering throws when it was told to stop.
struct RenderStopped {};

// The memory of each thread, kept from frame to frame, since new memory costs more time than
// writing into it.
struct BandMemory {
  tbb::enumerable_thread_specific<SplatBuffer> splats{};
  tbb::enumerable_thread_specific<std::vector<float>> rows{}, background{};
  const std::atomic<bool>* stop = nullptr;  // set by whoever wants no more of the frame; or null

  void throw_if_stopped() const {
    if (stop && *stop) throw RenderStopped{};
  }
};

// Draws skies and stars, the disc before them and bodies, unless these are null, into a
// frame of the projection's size, by all threads of the arena that calls.  Where there are borders,
// stars end at them, and bodies do not.  In a half frame, a value beyond the largest
// half (65504) is stored as that.  T is Imath::half or float.  Throws std::runtime_error, naming
// the pixel, if a value is not finite, and RenderStopped once `stop` is set.
template <class T>
void draw_bands(const FrameScene& scene, const SkyPass& sky, const BlobLayer& stars,
                const DiscPass* disc, const std::optional<SkyBorders>& borders,
                const BlobLayer* bodies, BandMemory& memory, ImageRgb<T>& frame);

}  // namespace domefall
