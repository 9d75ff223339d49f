// Motion blur: a frame as the mean of what is seen while its shutter is open.
#pragma once

#include "pipeline/image/frame_buffer.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/optics_store.h"

namespace domefall {

// Pixels of motion from one instant to the next.  The blobs of stars are 0.9 pixel wide at least, and a row
// of Gaussians 1.4 times their width apart ripples by 1e-4 of its height.
inline constexpr double kPixelsPerInstant = 1.25;
inline constexpr int kMostInstants = 64;

// How far the sky moves over the image between two states, in pixels: what 5 % of the image exceed.
// Places that show another sky than before are left out.
double motion_in_pixels(const FrameState& from, const ViewTracer& tracer_from, const FrameState& to,
                        const ViewTracer& tracer_to);

// The number of instants that a motion takes, from 1 to kMostInstants.
int instants_for_motion(double motion_in_pixels);

// The number of instants that the motion during a frame's exposure takes; of a dissolve, that of the view
// with the longer motion.  Show with an open shutter.
int instants_for(const Show& show, const FrameState& state, OpticsStore& optics);

// The mean of frames of one size.
class MeanFrame {
 public:
  void add(const HalfFrame& instant);
  void store(HalfFrame& frame) const;

 private:
  int count_ = 0;
  FloatImage sum_;
};

}  // namespace domefall
