// Frames of a show, in memory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// What one frame needs, decided before anything is made.
struct FramePlan {
  bool gravity = false;  // else no table
  bool table_one = false, table_three = false;
  bool background_one = false, background_three = false;  // anything to see but stars
  bool stars_one = false, stars_three = false;

  bool sees_three() const { return background_three || stars_three; }
};

FramePlan plan_frame(const Show& show, const FrameState& state);

struct StageTimes {
  double load_s = 0, tables_s = 0, stars_s = 0, pixels_s = 0;
  std::size_t table_nodes = 0, images = 0;
};

class Renderer {
 public:
  // threads: 0 for one per processor.  The show must outlive the renderer.
  Renderer(const Show& show, int threads);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer(Renderer&&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  // The same bytes for any number of threads, alone or in a run.  Throws InputError if an asset
  // cannot be read, std::runtime_error naming the pixel if a value is not finite.
  // Values beyond the largest half (65504) are recorded as that: the sensor saturates.
  HalfFrame render(const FrameState& state, StageTimes* times = nullptr);

  // Reads the skies' files now instead of at the first frame that shows them.  Throws InputError.
  void load_skies(bool three);

  int threads() const;

 private:
  const HoleOptics& optics_for(const FrameState& state, const FramePlan& plan);

  struct Arena;
  const Show& show_;
  Scene scene_;
  std::unique_ptr<Arena> arena_;
  std::optional<HoleOptics> optics_;  // kept while r stays the same
};

// The plan in words, one line per thing made or left out.
std::string describe(const FramePlan& plan, const StageTimes& times);

}  // namespace domefall
