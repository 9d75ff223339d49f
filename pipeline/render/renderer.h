// Frames of a show, in memory.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/sky/anti_aliasing.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

struct StageTimes {
  double load_s = 0, tables_s = 0, stars_s = 0, grid_s = 0, pixels_s = 0;
  double traced_fraction = 0;  // of the sky's pixels, those looked at one by one
  std::size_t table_nodes = 0, images = 0;
  int tables_made = 0;  // the others were kept from the frame before
  int pictures =
      1;  // instants that a frame with an open shutter is the mean of; the times are of all
};

class SkyPass;

class Renderer {
 public:
  // threads: 0 for one per processor.  The show must outlive the renderer.
  // Throws InputError unless 1 <= anti_aliasing.samples <= kMostSamples.
  Renderer(const Show& show, int threads, AntiAliasing anti_aliasing = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer(Renderer&&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  // The same bytes for any number of threads, alone or in a run.  Throws InputError if an asset
  // cannot be read, std::runtime_error naming the pixel if a value is not finite.
  // Values beyond the largest half (65504) are recorded as that: the sensor saturates.
  HalfFrame render(const FrameState& state, StageTimes* times = nullptr);
  // The same into a frame, whose memory is used again if it has the size: a new frame's memory costs
  // more than the light in it.
  void render(const FrameState& state, HalfFrame& frame, StageTimes* times = nullptr);

  // Reads the files that a frame needs now instead of when it is rendered.  Throws InputError.
  void load(const FramePlan& plan);

  // Reads a sky's files now instead of at the first frame that shows it.  Throws InputError.
  void load_sky(SkyRegion which);

  int threads() const;

 private:
  void render_instant(const FrameState& state, HalfFrame& frame, StageTimes& times);
  void make_bands(const SkyPass* pass, const Projection& projection, HalfFrame& frame);
  void render_one(const FrameState& state, HalfFrame& frame, StageTimes& times);
  double motion_between(const FrameState& from, const FrameState& to);
  int instants_for(const FrameState& state);
  // made: gets the number of tables that were not there yet.
  const HoleOptics& optics_for(const FrameState& state, const FramePlan& plan, int* made = nullptr);

  struct Arena;
  const Show& show_;
  SkyStore sky_store_;
  AntiAliasing anti_aliasing_;
  std::unique_ptr<Arena> arena_;
  std::optional<HoleOptics> optics_;  // kept while r stays the same
};

// The plan in words, one line per thing made or left out.
std::string describe(const FramePlan& plan, const StageTimes& times);

}  // namespace domefall
