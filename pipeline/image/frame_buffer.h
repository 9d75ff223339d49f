// A frame in memory is scene-linear RGB in the working space (ACEScg), with row 0 at the top.
#pragma once

#include <Imath/half.h>

#include <cstddef>
#include <vector>

namespace domefall {

template <class T>
struct ImageRgb {
  int width = 0, height = 0;
  std::vector<T> pixels;  // interleaved RGB, width * height * 3

  ImageRgb() = default;
  ImageRgb(int w, int h)
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}

  T* row(int y) {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 3;
  }
  const T* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) * 3;
  }
};

using HalfFrame = ImageRgb<Imath::half>;       // a rendered frame, as it goes into an EXR
using FloatImage = ImageRgb<float>;            // maps and oracles, and frames in full precision
using GradedFrame = ImageRgb<unsigned short>;  // a graded frame, 16 bits, display-encoded

// Returns the half frame of a rendered one.  Values are rounded to nearest with ties to even.
// Those above 65504, the largest half, become 65504, and negative ones 0.
HalfFrame half_frame(const FloatImage& frame);

}  // namespace domefall
