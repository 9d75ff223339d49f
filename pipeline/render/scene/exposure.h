// Defines the one scale on which skies and stars become pixel values.
#pragma once

#include <cmath>

#include "pipeline/show/frame_state.h"

namespace domefall {

// The luminance (cd/m^2) of pixel value 1 at 0 EV is ten times that of the Milky Way's brightest
// part.
inline constexpr double kReferenceLuminance = 1e-3;

// Returns the pixel value of 1 cd/m^2.
inline double exposure_scale(const FrameSettings& settings) {
  return std::exp2(settings.ev) / kReferenceLuminance;
}

// The illuminance (lux) of a star of magnitude 0 enters only the size at which stars are drawn.
inline constexpr double kMagnitudeZeroLux = 2.63e-6;

}  // namespace domefall
