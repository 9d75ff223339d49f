// A KeyedRenderer renders the frames of a show from the assets that the keys of its frames stand
// for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"

namespace domefall {

class KeyedRenderer {
 public:
  // The assets are read for their digests now, and for their contents when the first frame is
  // rendered.  `grade` is that of FrameKeys, `threads` that of Renderer.  With `explain` each
  // frame's plan, and what its stages cost, goes to standard error.  The show must outlive this.
  // Throws as FrameKeys.
  KeyedRenderer(const Show& show, std::vector<int> frames, std::string grade, int threads,
                bool explain = false);

  const FrameKeys& keys() const { return *keys_; }
  // Returns the number of threads of the renderer, once a frame was rendered.
  int threads() const { return renderer_->threads(); }

  // Renders one of the frames.  Throws as Renderer, and TemporaryError if an asset has another
  // content than when its digest was taken.
  void render(const FrameState& state, LayeredHalfFrame& frame) { render_keyed(state, frame); }
  void render(const FrameState& state, LayeredFloatFrame& frame) { render_keyed(state, frame); }

 private:
  template <class T>
  void render_keyed(const FrameState& state, LayeredFrame<T>& frame);
  template <class T>
  void render_once(const FrameState& state, LayeredFrame<T>& frame);
  bool assets_are_the_same();

  const Show& show_;
  std::vector<int> frames_;
  std::string grade_;
  int threads_;
  bool explain_;
  std::optional<FrameKeys> keys_;
  std::optional<Renderer> renderer_;
};

}  // namespace domefall
