// How finely the renderer samples a pixel for which one view ray is not enough.
#pragma once

namespace domefall {

// A difficult pixel is the mean of `samples` by `samples` view rays, which stand in an evenly
// spaced square.  Difficult are pixels near the edge of a sky, and those that a border between two
// squares of a grid may cross.  All others have one view ray, whose light is filtered by its footprint.
//
// Frames are rendered with the defaults, and frame keys do not contain these settings.  A setting
// that a user may choose has to enter the keys first.
struct AntiAliasing {
  int samples = 4;          // along each axis, 1 to kMostSamples; 1 makes no pixel difficult
  bool everywhere = false;  // makes every pixel difficult
  // Traces a view ray through every pixel.  Else most pixels are interpolated where the view is
  // smooth (RayGrid).
  bool every_pixel = false;
};

inline constexpr int kMostSamples = 64;

// 256 view rays for every pixel: what the error of a frame is measured against.
inline constexpr AntiAliasing kReferenceAntiAliasing{16, true};

}  // namespace domefall
