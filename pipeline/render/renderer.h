// Frames of a show, in memory.
#pragma once

#include <memory>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/scene/optics_store.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/sky/anti_aliasing.h"
#include "pipeline/render/stage_times.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

class Renderer {
 public:
  // threads: 0 for one for each processor, and never more than that.  The show must outlive the renderer.
  // Throws InputError unless 1 <= anti_aliasing.samples <= kMostSamples.
  Renderer(const Show& show, int threads, AntiAliasing anti_aliasing = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer(Renderer&&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  // The same bytes for any number of threads, alone or in a run.  Throws InputError if an asset
  // cannot be read, and std::runtime_error, naming the pixel, if a value is not finite.
  // Values beyond the largest half (65504) are recorded as that: the sensor saturates.
  HalfFrame render(const FrameState& state, StageTimes* times = nullptr);
  // The same into a frame, whose memory is used again if it has the size: a new frame's memory costs
  // more than the light in it.
  void render(const FrameState& state, HalfFrame& frame, StageTimes* times = nullptr);

  // Reads the files that a frame needs now instead of when it is rendered.  Throws InputError.
  void load(const FramePlan& plan);

  // Reads a sky's files now instead of at the first frame that shows it.  Throws InputError.
  void load_sky(SkyRegion sky);

  int threads() const;

 private:
  struct Memory;

  void render_instant(const FrameState& state, HalfFrame& frame, StageTimes& times);
  void render_view(const FrameState& state, HalfFrame& frame, StageTimes& times);

  const Show& show_;
  AntiAliasing anti_aliasing_;
  SkyStore skies_;
  OpticsStore optics_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace domefall
