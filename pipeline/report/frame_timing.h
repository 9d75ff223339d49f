// These functions measure what it costs to render a frame, and by how much two frames differ.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

// Repeats says how often a frame is rendered to find its least time.  A longer time comes from a
// cold cache, from other programs or, in the first rendering, from the reading of files.  There are
// at most `most` renderings, and at least two of them unless `most` is 1.  No further one is begun
// once all but the first have taken `enough_s` seconds of CPU time.
struct Repeats {
  int most = 7;
  double enough_s = 1.5;
};

struct TimedFrame {
  HalfFrame frame;
  double seconds;  // CPU, all threads together, of the quickest rendering
};

// Renders the state several times into the same memory, as a run does with its frames, and returns
// the frame with its least time.
TimedFrame time_frame(Renderer& renderer, const FrameState& state, Repeats repeats);

// Does the same with the show's frame 0, by a renderer of its own.
TimedFrame time_frame(const Show& show, AntiAliasing anti_aliasing, int threads, Repeats repeats);

// Returns the CPU seconds of copying the frame's half floats, by the quickest of several series of
// copies.
double copy_seconds(const HalfFrame& frame);

// A FrameDifference is the root mean square and the largest of the differences between two frames,
// over the three values of every pixel that the projection shows.  White is 1.
struct FrameDifference {
  double rms, worst;
};
FrameDifference difference(const GradedFrame& a, const GradedFrame& b,
                           const Projection& projection);

}  // namespace domefall
