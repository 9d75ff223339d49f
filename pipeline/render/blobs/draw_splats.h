// Splats draw hundreds of thousands of faint stars as blobs of one width.  Each star is dropped
// onto the pixels around it as a cubic B-spline.  A blob is wider than the spline, so afterwards
// all rows are blurred at once by the difference.  A splat costs a fraction of an ellipse, and the
// blur costs the same for any number of splats.
//
// The spline has a variance of 1/3 pixel^2 along each axis wherever its middle lies, and its values
// add up to 1 except for rounding.  No star's light therefore depends on its position.  The blur is
// the same everywhere.  Towards the edge, however, blobs are stretched: on a dome along the
// tangent, on a flat image in all directions.  For this a star is dropped not at one point but at a
// few points, which have the moments of a Gaussian.  The fourth moment of the blur is chosen so
// that the whole has that of a Gaussian over the square of a pixel, which is what ellipse blobs
// are.
//
// The difference to ellipse blobs was measured in parts of the peak.  It is 0.05 at a width of 0.9
// pixel, where the shape of the spline shows, 0.02 at 1.14 (4k), 0.01 at 2, and 0.04 at the rim of
// a dome of 1024 pixels.  As a star of width 0.9 pixel drifts, its brightest pixel changes by a
// factor of 1.33, against 1.32 for ellipses.
//
// SplatBuckets choose and sort the splats of a frame.  A SplatBuffer holds the rows on which one
// thread drops and blurs them.  The loops that do so are declared here.
#pragma once

#include <cstddef>

#include "pipeline/render/scene/star_image.h"

namespace domefall {

// A SplatFrame holds what the loops need to know about the frame.
struct SplatFrame {
  float middle_x, middle_y;
  float unit2;     // square of the radians (dome) or of tan(theta/2) (flat image) per pixel
  float variance;  // of the blob in the middle of the image, pixel^2
  float density;   // 1 / solid angle of the pixel in the middle, 1 / sr
};

// A pixel has red, green, blue and an unused fourth channel.  One load and one store then move two
// pixels and seldom straddle cache lines.  It measured slower to move all four columns of a spline
// at once, or one by one.
inline constexpr int kSplatChannels = 4;
// The loops may touch this many floats beyond the end of a row.
inline constexpr int kSplatFloatsBeyond = 64;

// SplatRows has a pointer to the first pixel of each row, from row `first` on.
struct SplatRows {
  float* const* row;
  int first;
};

// This is the distance between a star and the farthest of the points at which it is dropped.  It is
// in units of the width (square root of the variance) that the spline and the blur leave to the
// points.  From each point a splat touches two more pixels.
inline constexpr float kFarthestPoint = 2.8569700f;

// Drops `count` stars onto the rows of a dome or of a flat image.
void drop_splats(bool dome, const SplatFrame& frame, const StarImage* images, std::size_t count,
                 const SplatRows& rows);

// A SplatBlur is a blur with an even kernel: the sum of tap[|n|] times the n-th pixel from here,
// for |n| <= taps.
struct SplatBlur {
  const float* tap;
  int taps;  // at most kMostSplatTaps
};
inline constexpr int kMostSplatTaps = 64;

// Blurs downwards and writes `lines` rows of `count` floats to `out`, which are `stride` floats
// apart.  `rows` holds lines + 2 taps rows, because successive lines read mostly the same rows.
void blur_down(const SplatBlur& blur, const float* const* rows, int lines, int count, float* out,
               std::ptrdiff_t stride);

// Blurs a row of `count` pixels along itself and adds it to rgb[3 * count].  `between` has room for
// a row.
void blur_along(const SplatBlur& blur, const float* row, int count, float* between, float* rgb);

}  // namespace domefall
