// A frame of halves or of floats, which overlays are drawn over.
#pragma once

#include <variant>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

struct FrameRef {
  int width, height;
  std::variant<HalfFrame*, FloatImage*> pixels;

  // Any frame is one, so that it is given as it is.
  FrameRef(HalfFrame& frame) : width(frame.width), height(frame.height), pixels(&frame) {}
  FrameRef(FloatImage& frame) : width(frame.width), height(frame.height), pixels(&frame) {}
};

}  // namespace domefall
