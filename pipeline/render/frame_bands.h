// Draws the pixels of a frame in bands of rows.  Each band is shaded, covered with stars and stored
// while it is in the cache of one thread.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/image/layer.h"
#include "pipeline/render/blobs/blob_layer.h"
#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/disc/gas_pass.h"
#include "pipeline/render/frame_bodies.h"
#include "pipeline/render/frame_mattes.h"
#include "pipeline/render/rays/sky_borders.h"
#include "pipeline/render/sky/sky_pass.h"

namespace domefall {

// Rendering throws RenderStopped when it was told to stop.
struct RenderStopped {};

// LayerRows are the memory in which the light of a band is divided among layers.
struct LayerRows {
  std::vector<float> before;
  // By layer: its light, and what a layer that hides leaves of what is behind it, or nothing.
  std::array<std::vector<float>, kLayers.size()> light, left;
  std::array<bool, kLayers.size()> taken;
};

// BandMemory is the memory of each thread.  It is kept from frame to frame, since getting new
// memory takes more time than writing into it.
struct BandMemory {
  tbb::enumerable_thread_specific<SplatBuffer> splats{};
  tbb::enumerable_thread_specific<std::vector<float>> rows{}, background{};
  tbb::enumerable_thread_specific<LayerRows> layers{};
  const std::atomic<bool>* stop = nullptr;  // set to end the frame early; or null

  void throw_if_stopped() const {
    if (stop && *stop) throw RenderStopped{};
  }
};

// DrawnLight is what is drawn over the skies, in this order.  What is null is not there.
struct DrawnLight {
  const BlobLayer* crowded_skies = nullptr;  // those that are drawn as blobs
  // Stars end at the borders, if there are any.
  const BlobLayer* stars = nullptr;
  const SkyBorders* borders = nullptr;
  const DiscPass* disc = nullptr;  // without height
  const GasPass* gas = nullptr;
  std::span<const BodyLayer> bodies{};
  const MattePass* mattes = nullptr;  // of all of this, for frames with mattes
};

// Draws skies and what is before them into a frame of the projection's size, and into those of its
// layers that it has, by all threads of the arena that calls.  In a half frame, a value beyond the
// largest half (65504) is stored as the largest.  T is Imath::half or float.  Throws
// std::runtime_error, naming the pixel, if a value is not finite, and RenderStopped once `stop` is
// set.
template <class T>
void draw_bands(const FrameScene& scene, const SkyPass& sky, const DrawnLight& drawn,
                BandMemory& memory, LayeredFrame<T>& frame);

}  // namespace domefall
