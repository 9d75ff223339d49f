// A RenderedFrame is a frame in the precisions that the files of a show ask for.
#pragma once

#include "pipeline/image/frame_file.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

struct RenderedFrame {
  explicit RenderedFrame(const Show& show) {
    if (!show.output.linear) return;
    if (keeps_floats(show))
      full = LayeredFloatFrame(show.output.layers);
    else
      half = LayeredHalfFrame(show.output.layers);
  }

  // Says whether the show's scene-linear files are of floats.
  static bool keeps_floats(const Show& show) {
    return show.output.linear && show.output.linear->pixels == ExrPixels::kFloat;
  }

  LayeredHalfFrame half;   // its picture is graded
  LayeredFloatFrame full;  // in full precision, where the show's scene-linear files are of floats
};

// Renders a frame by any renderer of both kinds, into memory that is used again.
template <class AnyRenderer>
void render_for_files(AnyRenderer& renderer, const Show& show, const FrameState& state,
                      RenderedFrame& frame) {
  if (!RenderedFrame::keeps_floats(show)) return renderer.render(state, frame.half);
  renderer.render(state, frame.full);
  frame.half.picture = half_frame(frame.full.picture);
}

// Writes the scene-linear file of a show that has one.  Throws as write_frame.
inline void write_linear(const std::filesystem::path& path, const Show& show,
                         const RenderedFrame& frame, const FrameInfo& info) {
  const ExrCompression compression = show.output.linear->compression;
  if (RenderedFrame::keeps_floats(show))
    write_frame(path, frame.full, info, compression);
  else
    write_frame(path, frame.half, info, compression);
}

}  // namespace domefall
