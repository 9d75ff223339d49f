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

// Whether the estimate renders less than a tenth of the show's pixels.  A single frame of 4096 pixels
// or a few seconds of tiny ones are rendered almost as soon as measured.
bool is_worth_measuring(const Show& show);

// Frames spread over the show are rendered, graded and written (to the system's temporary folder) as
// domefall render does it, at three reduced sizes, each twice as wide as the one before.  What a doubling
// adds grows by a constant factor, 2 to 4, that the three tell; by the clock the largest of them says how long
// that takes on this machine with what else runs on it now.
// Measured against renders of orbits and falls with stars on a machine full of other work (load 10 on 2
// processors): within 20 % at 4096 pixels, 10 % at 1024 and 2048, as far as that load keeps still.
// Throws InputError or TemporaryError where nothing can be written.
// Grader: null without a grade.
RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader);

}  // namespace domefall
