// The inner loops of dots (star_dots.h): dropping them onto rows of pixels, and blurring those.
#pragma once

#include <cstddef>

#include "pipeline/render/scene/star_image.h"

namespace domefall {

// What of a picture the loops need.
struct SplatFrame {
  float middle_x, middle_y;
  float unit2;     // of radians, or tan(theta/2), per pixel
  float variance;  // of the blob in the picture's middle, pixel^2
  float density;   // 1 / the solid angle of the pixel in the middle
};

// A pixel: red, green, blue and nothing, so that two of them are one load and one store, which seldom
// straddle cache lines.  All four of a spline's columns at once, or one by one, measured slower.
inline constexpr int kSplatChannels = 4;
// Beyond a row's end, floats that the loops may touch.
inline constexpr int kSplatFloatsBeyond = 64;

// The first pixels of rows, by row from `first` on.
struct SplatRows {
  float* const* row;
  int first;
};

// No point at which a star is dropped is farther from it, in widths of what is missing; a dot touches two
// pixels more.
inline constexpr float kFarthestPoint = 2.8569700f;

// Drops stars about their places in pixels, each with its light.
void drop_splats(bool dome, const SplatFrame& frame, const StarImage* images, std::size_t count,
                 const SplatRows& rows);

// A blur: the sum of tap[n] times what stands n pixels, or rows, before and after.
struct SplatBlur {
  const float* tap;
  int taps;  // at most kMostSplatTaps
};
inline constexpr int kMostSplatTaps = 64;

// Down `lines` rows at once, which have most of what they read in common.  rows: lines + 2 taps; out:
// lines of `count` floats, `stride` apart.
void blur_down(const SplatBlur& blur, const float* const* rows, int lines, int count, float* out,
               std::ptrdiff_t stride);

// Along a row of `count` pixels, added to rgb[3 * count].  between: room for a row.
void blur_along(const SplatBlur& blur, const float* row, int count, float* between, float* rgb);

}  // namespace domefall
