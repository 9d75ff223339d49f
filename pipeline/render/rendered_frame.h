// A RenderedFrame is a frame in the precisions that the files of a show ask for.
#pragma once

#include "pipeline/image/frame_file.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

struct RenderedFrame {
  HalfFrame half;   // the one that is graded
  FloatImage full;  // in full precision, where the show's scene-linear files are of floats
};

// Says whether the show's scene-linear files are of floats.
inline bool keeps_floats(const Show& show) {
  return show.output.linear && show.output.linear->pixels == ExrPixels::kFloat;
}

// Renders a frame by any renderer of both kinds, into memory that is used again.
template <class AnyRenderer>
void render_for_files(AnyRenderer& renderer, const Show& show, const FrameState& state,
                      RenderedFrame& frame) {
  if (!keeps_floats(show)) return renderer.render(state, frame.half);
  renderer.render(state, frame.full);
  frame.half = half_frame(frame.full);
}

// Writes the scene-linear file of a show that has one.  Throws as write_frame.
inline void write_linear(const std::filesystem::path& path, const Show& show,
                         const RenderedFrame& frame, const FrameInfo& info) {
  const ExrCompression compression = show.output.linear->compression;
  if (keeps_floats(show))
    write_frame(path, frame.full, info, compression);
  else
    write_frame(path, frame.half, info, compression);
}

}  // namespace domefall
