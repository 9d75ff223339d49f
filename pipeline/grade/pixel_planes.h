// PixelPlanes are pixels as three arrays of floats, one for each channel, which SIMD loops over
// pixels take.
#pragma once

#include <Imath/half.h>

#include <array>

#include "pipeline/grade/grade_settings.h"

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

// Takes ACEScg through an ASC CDL in ACEScct (S-2016-001) and back, by SIMD loops, so that a CDL
// which changes from frame to frame costs no more than one that stays the same.  As in OpenColorIO
// nothing is clamped, and a power leaves negative codes as they are.  Black stays black, whatever
// the CDL makes of it.  Pixels of -1 stay so, and pixels that become infinite become -1, too.  The
// measured error is within 4e-6 of the value itself and of the largest channel.
void apply_cdl(const Cdl& given, PixelPlanes& planes, int count);

}  // namespace domefall
