// Computes motion blur: a frame is the mean of several instants while its shutter is open.
#pragma once

#include <vector>

#include "pipeline/image/layer.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

// The sky moves by this many pixels from one instant to the next.  Blobs of stars have a sigma of
// at least 0.9 pixel, so a moving star is a row of Gaussians at most 1.4 sigma apart.  By Poisson's
// sum formula a row d sigma apart ripples by 2 exp(-2 pi^2/d^2) of its mean, which is 1e-4 here.
inline constexpr double kPixelsPerInstant = 1.25;
inline constexpr int kMostInstants = 64;

// Returns the distance in pixels by which the sky moves over the image between two states.  Only
// 5 % of the image moves farther than this.  Places that show another sky in the second state are
// left out.
double motion_in_pixels(const FrameState& from, const ViewTracer& tracer_from, const FrameState& to,
                        const ViewTracer& tracer_to);

// Returns the number of instants, from 1 to kMostInstants, that makes a motion look continuous.
int instants_for_motion(double motion_in_pixels);

// Returns the number of instants for the motion during a frame's exposure.  In a dissolve the view
// with the longer motion counts.  The show must have an open shutter.
int instants_for(const Show& show, const FrameState& state, LensStore& lenses);

// A MeanFrame is the mean of frames of one size, and of each of their layers.  T is Imath::half or
// float.
class MeanFrame {
 public:
  template <class T>
  void add(LayeredFrame<T>& instant);
  template <class T>
  void store(LayeredFrame<T>& frame) const;

 private:
  int count_ = 0;
  std::vector<std::vector<float>> sums_;  // in the order of lights() and alphas()
};

}  // namespace domefall
