// What rendering a frame costs, and how far two frames are apart.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

// How long to go on rendering a frame for its least time: the rest is a cold cache, a busy
// neighbour or, at the first rendering, the reading of files.  At least two renderings unless
// `most` is 1, at most that many, and none begun when all but the first have taken so much CPU
// time.
struct Repeats {
  int most = 7;
  double enough_s = 1.5;
};

struct TimedFrame {
  HalfFrame frame;
  double seconds;  // CPU, all threads together, of the quickest rendering
};

// Renders the state again and again into the same memory, as a run's frames go.
TimedFrame time_frame(Renderer& renderer, const FrameState& state, Repeats repeats);

// The same for the show's frame 0 by a renderer of its own.
TimedFrame time_frame(const Show& show, AntiAliasing anti_aliasing, int threads, Repeats repeats);

// CPU seconds of copying the frame's half floats, by the quickest of several rows of copies.
double copy_seconds(const HalfFrame& frame);

// Root of the mean square and largest difference, of all pixels inside the picture and their three
// values, white being 1.
struct FrameDifference {
  double rms, worst;
};
FrameDifference difference(const GradedFrame& a, const GradedFrame& b,
                           const Projection& projection);

}  // namespace domefall
