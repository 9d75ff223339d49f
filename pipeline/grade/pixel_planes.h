// PixelPlanes are pixels as three arrays of floats, one for each channel, which SIMD loops over
// pixels take.
#pragma once

#include <Imath/half.h>

#include <array>

namespace domefall {

// None of the values in them is NaN.
struct PixelPlanes {
  static constexpr int kSize = 512;
  alignas(64) std::array<float, kSize> red, green, blue;
};

// Splits `count` pixels, at most kSize.  A pixel with a channel that is negative (-0 is, too),
// infinite or NaN becomes -1 in all channels.  Returns how many pixels are black, which are 0 in
// all channels.
int split_pixels(const Imath::half* rgb, int count, PixelPlanes& planes);

}  // namespace domefall
