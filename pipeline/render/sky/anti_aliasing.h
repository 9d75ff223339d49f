// How finely a renderer looks at a pixel that one look does not do justice.
#pragma once

namespace domefall {

// The looks of a pixel stand in a square of `samples` by `samples`, evenly spaced; the pixel is their
// mean.  A pixel is looked at so if it is difficult (near the edge of a sky, or with a long and narrow
// footprint on a grid), all others have one look, filtered by its footprint.
//
// The default makes the frames that Domefall renders, and frame keys say nothing of it: a setting
// that a user may choose has to enter them first.
struct AntiAliasing {
  int samples = 4;          // along each axis, 1 to kMostSamples; 1: one look for every pixel
  bool everywhere = false;  // every pixel is difficult
  // Looks at every pixel; else where the view is smooth most are interpolated (RayGrid).
  bool every_pixel = false;
};

inline constexpr int kMostSamples = 64;

// 256 looks for every pixel: what the error of a frame is measured against.
inline constexpr AntiAliasing kReferenceAntiAliasing{16, true};

}  // namespace domefall
