// Dithering takes 16 bits to 8 without contours.
#pragma once

#include <cstdint>

namespace domefall {

// Rounds rows of `width` pixels rgb[rows][width][3], the first of which is row y of the frame, to 8
// bits in `out`.
//
// Noise is added before rounding.  It is the sum of two uniform distributions, each as wide as a
// step of 8 bits.  This makes the mean of the result, taken over the noise, equal to the value, and
// the variance of the result the same for all values (Lipshitz, Wannamaker and Vanderkooy,
// "Quantization and dither", 1992).  Below half a step, and as near to white, that sum would have
// to be cut.  There the noise is one uniform distribution, which gives a mean just as exact.  So 0
// stays 0 and 65535 becomes 255.
//
// The noise is a function of the frame's number, of place and of channel alone.
void dither_rows(const unsigned short* rgb, int width, int rows, int y, int frame,
                 std::uint8_t* out);

}  // namespace domefall
