// How long a show will take to render here, from a few frames of it.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

struct RenderTime {
  double seconds = 0;  // of the whole show
  double frame_s = 0;  // seconds each
  int threads = 0;
};

// Frames spread over the show are rendered, graded and written (to the system's temporary folder) as
// domefall render does it, at two reduced sizes; the time of a frame is a constant and a part that goes
// with its pixels.  Throws InputError or TemporaryError where nothing can be written.
// Grader: null without a grade.
RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader);

}  // namespace domefall
