// A FrameRef refers to a frame of halves or of floats over which overlays are drawn.
#pragma once

#include <variant>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

struct FrameRef {
  int width, height;
  std::variant<HalfFrame*, FloatImage*> pixels;

  // The constructors are implicit, so that either kind of frame can be passed as it is.
  FrameRef(HalfFrame& frame) : width(frame.width), height(frame.height), pixels(&frame) {}
  FrameRef(FloatImage& frame) : width(frame.width), height(frame.height), pixels(&frame) {}
};

}  // namespace domefall
