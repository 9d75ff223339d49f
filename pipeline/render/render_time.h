// A RenderTime says how long a show takes to render on this machine, estimated from a few frames.
#pragma once

#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

struct RenderTime {
  double seconds = 0;      // of the whole show
  double frame_s = 0;      // of one frame
  double processor_s = 0;  // the processor time of one frame, which other programs hardly change
  double light_part = 0;   // its part for light; the rest is for the grade and the files
  int threads = 0;
  double linear_bytes = 0, graded_bytes = 0;  // of one frame's files; 0 where none is made
};

// Says whether the estimate renders less than a twentieth of the show's pixels, without those that
// it renders again for the light alone.  A single frame of 4096 pixels or a few seconds of small
// frames are rendered almost as soon as measured.
bool is_worth_measuring(const Show& show);

// Renders, grades and writes frames spread over the show, as domefall render does it but into a
// scratch folder.  Frames of at most 1024 pixels are made at their own size alone.  Larger ones are
// made at three reduced sizes, each twice as wide as the one before.  The processor time that a
// doubling adds is taken to grow by a constant factor from one doubling to the next.  The three
// sizes give this factor, which lies between 2 and 4.  The clock at the largest size turns
// processor time into seconds on this machine under its present load.  `grader` is null for a show
// without a grade.
//
// Of a frame with an open shutter one instant is measured, and it counts as often as the frame has
// instants.  The files' sizes are continued from the two larger sizes to the full one by the power
// of the width that lies between those two.
//
// The estimate was measured on orbits and falls with stars, on a machine full of other work (load
// 10 on 2 processors).  It was within 20 % at 4096 pixels and within 10 % at 1024 and 2048 as long
// as that load kept still.  Throws TemporaryError where nothing can be written.
RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader);

// Returns, for each of these frames, the processor time that its light takes.  The unit is the mean
// of all, and the times are all 0 if nothing takes time.  The light is measured at both ends of
// each segment, and at some frames between them.  It is rendered at a reduced size and at one
// instant, and it counts as often as an open shutter has instants.  Between these frames the cost
// is interpolated.  A show of very many segments is sampled evenly.  `frames` are sorted, and an
// empty list gives an empty one.  `renderer` is one of the show.  The measurement takes about a
// third of a second of processor time.
std::vector<double> relative_light_costs(const Show& show, const std::vector<int>& frames,
                                         Renderer& renderer);

}  // namespace domefall
