// Pictures in memory, with row 0 at the top.  A frame is scene-linear RGB in the working space
// (ACEScg).
#pragma once

#include <Imath/half.h>

#include <cstddef>
#include <string>
#include <utility>
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
  const T* row(int y) const { return const_cast<ImageRgb*>(this)->row(y); }
};

using HalfFrame = ImageRgb<Imath::half>;       // a rendered frame, as it goes into an EXR
using FloatImage = ImageRgb<float>;            // maps and oracles, and frames in full precision
using GradedFrame = ImageRgb<unsigned short>;  // a graded frame, 16 bits, display-encoded

// Returns the half frame of a rendered one.  Values are rounded to nearest with ties to even.
// Those above 65504, the largest half, become 65504, and negative ones 0.
HalfFrame half_frame(const FloatImage& frame);

// A ChannelImage is a picture whose channels are not colours, those of a pixel side by side.
struct ChannelImage {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // their names; a layer's are LAYER.CHANNEL
  std::vector<float> pixels;          // [height][width][channels.size()]

  ChannelImage() = default;
  ChannelImage(int w, int h, std::vector<std::string> names)
      : width(w),
        height(h),
        channels(std::move(names)),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * channels.size()) {}

  float* pixel(int x, int y) {
    const auto place =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return pixels.data() + place * channels.size();
  }
  const float* pixel(int x, int y) const { return const_cast<ChannelImage*>(this)->pixel(x, y); }
};

// Returns the greatest of `count` values, or 0 of none.  A black frame is known by it.
unsigned short greatest_value(const unsigned short* values, std::size_t count);

// Returns the greatest of half floats without their signs, whose bits are ordered as they are.
// Infinities and NaNs come last, at 0x7c00 and above.
unsigned short greatest_magnitude(const unsigned short* halves, std::size_t count);

}  // namespace domefall
