// Motion blur: a frame as the mean of what is seen while its shutter is open.
#pragma once

#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Pictures to the pixel of motion: blobs of stars are 0.9 pixel wide at least, and a row of Gaussians
// 1.4 times their width apart ripples by 1e-4 of its height.
inline constexpr double kPixelsPerInstant = 1.25;
inline constexpr int kMostInstants = 64;

// How far the sky moves over the picture between two states, pixels: what 5 % of the picture exceed.
// What has another sky before it than before is left out.
double motion_in_pixels(const FrameState& from, const ViewTracer& tracer_from, const FrameState& to,
                        const ViewTracer& tracer_to);

// How many pictures the motion takes, from 1 to kMostInstants.
int instants_for_motion(double motion_in_pixels);

// The mean of pictures of one size.
class MeanFrame {
 public:
  void add(const HalfFrame& picture);
  void store(HalfFrame& frame) const;

 private:
  int count_ = 0;
  FloatImage sum_;
};

}  // namespace domefall
