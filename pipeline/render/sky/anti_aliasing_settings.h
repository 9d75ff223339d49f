// These settings say how finely the renderer samples a pixel for which one view ray is not enough.
#pragma once

namespace domefall {

// A difficult pixel is the mean of `samples` by `samples` view rays, which form an evenly spaced
// square.  Pixels near the edge of a sky are difficult, and so are pixels that a border between two
// squares of a grid may cross.  All others have one view ray, whose light is filtered by its
// footprint.
//
// Frames are rendered with the defaults, and frame keys do not contain these settings.  Before a
// user may choose a setting, it has to enter the keys.
struct AntiAliasing {
  int samples = 4;          // along each axis, 1 to kMostSamples; 1 makes no pixel difficult
  bool everywhere = false;  // makes every pixel difficult
  // Traces a view ray through every pixel.  Otherwise most pixels are interpolated where the view
  // is smooth (RayGrid).
  bool every_pixel = false;
};

inline constexpr int kMostSamples = 64;

// The error of a frame is measured against 256 view rays for every pixel.
inline constexpr AntiAliasing kReferenceAntiAliasing{16, true};

}  // namespace domefall
