// The one scale on which skies and stars become pixel values.
#pragma once

#include <cmath>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Luminance (cd/m^2) of pixel value 1 at 0 EV: ten times the brightest of the Milky Way.
inline constexpr double kReferenceLuminance = 1e-3;

// Pixel value per cd/m^2.
inline double exposure_scale(const FrameSettings& picture) {
  return std::exp2(picture.ev) / kReferenceLuminance;
}

// Illuminance (lux) of a star of magnitude 0, for the brightness that a blob's size goes by.
inline constexpr double kMagnitudeZeroLux = 2.63e-6;

}  // namespace domefall
