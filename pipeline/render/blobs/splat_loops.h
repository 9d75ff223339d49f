// The inner loops of splats (splat_kernel.h): one drops them onto rows of pixels, the others blur
// the rows.
#pragma once

#include <cstddef>

#include "pipeline/render/scene/star_image.h"

namespace domefall {

// What the loops need of the frame.
struct SplatFrame {
  float middle_x, middle_y;
  float unit2;     // square of the radians (dome) or of tan(theta/2) (flat image) per pixel
  float variance;  // of the blob in the image's middle, pixel^2
  float density;   // 1 / solid angle of the pixel in the middle, 1 / sr
};

// A pixel has red, green, blue and a fourth channel that stays unused, so that one load and one
// store, which seldom straddle cache lines, move two pixels.  Moving all four of a spline's columns
// at once, or one by one, measured slower.
inline constexpr int kSplatChannels = 4;
// The floats beyond a row's end that the loops may touch.
inline constexpr int kSplatFloatsBeyond = 64;

// The first pixel of each row, from row `first` on.
struct SplatRows {
  float* const* row;
  int first;
};

// The distance between a star and the farthest of the points at which it is dropped, in units of
// the width (square root of the variance) that the spline and the blur leave to the points.  From
// each point a splat touches two pixels more.
inline constexpr float kFarthestPoint = 2.8569700f;

// Drops `count` stars onto the rows.  `dome` tells the two projections apart.
void drop_splats(bool dome, const SplatFrame& frame, const StarImage* images, std::size_t count,
                 const SplatRows& rows);

// A blur with a kernel that is even: the sum of tap[|n|] times the pixel n places on, |n| <= taps.
struct SplatBlur {
  const float* tap;
  int taps;  // at most kMostSplatTaps
};
inline constexpr int kMostSplatTaps = 64;

// Blurs downwards and writes `lines` rows of `count` floats to `out`, which are `stride` apart.
// `rows` holds lines + 2 taps rows, since most of what they read the lines have in common.
void blur_down(const SplatBlur& blur, const float* const* rows, int lines, int count, float* out,
               std::ptrdiff_t stride);

// Blurs a row of `count` pixels along itself and adds it to rgb[3 * count].  `between` has room for
// a row.
void blur_along(const SplatBlur& blur, const float* row, int count, float* between, float* rgb);

}  // namespace domefall
