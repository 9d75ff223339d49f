// What rendering a frame costs, and how far two frames are apart.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

// How often a frame is rendered to find its least time.  What exceeds the least is a cold cache, a
// busy neighbour or, in the first rendering, the reading of files.  There are at most `most`
// renderings, and at least two of them unless `most` is 1.  None is begun once all but the first
// have taken `enough_s` seconds of CPU time.
struct Repeats {
  int most = 7;
  double enough_s = 1.5;
};

struct TimedFrame {
  HalfFrame frame;
  double seconds;  // CPU, all threads together, of the quickest rendering
};

// Renders the state again and again into the same memory, as a run does with its frames.
TimedFrame time_frame(Renderer& renderer, const FrameState& state, Repeats repeats);

// Does the same with the show's frame 0, by a renderer of its own.
TimedFrame time_frame(const Show& show, AntiAliasing anti_aliasing, int threads, Repeats repeats);

// CPU seconds of copying the frame's half floats, by the quickest of several series of copies.
double copy_seconds(const HalfFrame& frame);

// The root of the mean square and the largest of the differences, over the three values of every
// pixel that the projection shows.  White is 1.
struct FrameDifference {
  double rms, worst;
};
FrameDifference difference(const GradedFrame& a, const GradedFrame& b,
                           const Projection& projection);

}  // namespace domefall
