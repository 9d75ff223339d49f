// Renders the frames of a show into memory.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "pipeline/image/layer.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/sky/anti_aliasing_settings.h"
#include "pipeline/render/stage_times.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {

struct FrameScene;

class Renderer {
 public:
  // `threads` is the number of threads, at most one for each processor, or 0 for that many.  The
  // show must outlive the renderer.  Throws InputError unless
  // 1 <= anti_aliasing.samples <= kMostSamples, and TemporaryError if so many threads cannot be
  // started.
  explicit Renderer(const Show& show, int threads = 0, AntiAliasing anti_aliasing = {},
                    SkyDetail detail = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Renders a frame.  It has the same bytes for any number of threads, alone or in a run.  Values
  // beyond the largest half (65504) are stored as the largest.  Throws InputError if an asset
  // cannot be read, and std::runtime_error, naming the pixel, if a value is not finite.  Throws as
  // draw_titles and draw_overlays, too.
  HalfFrame render(const FrameState& state, StageTimes* times = nullptr);
  // Renders into `frame`, whose memory is used again if it has the right size.  This saves the time
  // of getting new memory.
  void render(const FrameState& state, HalfFrame& frame, StageTimes* times = nullptr);
  // Renders in full precision, so that values beyond the largest half are kept.
  void render(const FrameState& state, FloatImage& frame, StageTimes* times = nullptr);
  // Renders the picture and those layers that the frame has, whatever their size was.
  void render(const FrameState& state, LayeredHalfFrame& frame, StageTimes* times = nullptr);
  void render(const FrameState& state, LayeredFloatFrame& frame, StageTimes* times = nullptr);

  // From now on render() throws RenderStopped (frame_bands.h) soon after the flag is set, either
  // between two stages or amid the drawing.  With null it runs to its end again.  The flag must
  // outlive its use.
  void stop_when(const std::atomic<bool>* flag);

  // Reads the files that a frame needs before it is rendered.  Throws InputError if one cannot be
  // read.
  void load(const FramePlan& plan);

  // Reads the files of a sky before any frame shows it.  Throws InputError if one cannot be read.
  void load_sky(SkyRegion sky);

  // Loads a map of a sky, and returns the luminance (cd/m^2, before the gain) that is subtracted
  // from it as black.
  double sky_black(SkyRegion sky, const PanoramaSky& map);

  int threads() const;

 private:
  struct Memory;

  // Each of these functions renders by way of the next one, for T = Imath::half and float.  `gap`
  // is the time to the next instant that is seen, in frames.
  template <class T>
  void render_frame(const FrameState& state, LayeredFrame<T>& frame, StageTimes* times);
  template <class T>
  void render_exposed(const FrameState& state, LayeredFrame<T>& frame, StageTimes* times);
  template <class T>
  void render_instant(const FrameState& state, double gap, LayeredFrame<T>& frame,
                      StageTimes& times);
  template <class T>
  void render_faded(const FrameState& state, double gap, LayeredFrame<T>& frame, StageTimes& times);
  template <class T>
  void render_view(const FrameState& state, double gap, LayeredFrame<T>& frame, StageTimes& times);
  template <class T>
  void render_parts(const FrameScene& scene, const PixelParts& parts, LayeredFrame<T>& frame,
                    StageTimes& times);
  template <class T>
  void render_image(const FrameScene& scene, LayeredFrame<T>& image, StageTimes& times);

  const Show& show_;
  AntiAliasing anti_aliasing_;
  SkyStore skies_;
  std::optional<DiscLight> disc_light_;  // made when a disc is first seen
  LensStore lenses_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace domefall
