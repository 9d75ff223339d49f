// Defines the one scale on which light becomes pixel values.
#pragma once

#include <cmath>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Returns the pixel value of 1 cd/m^2.  FrameScene takes it once for each instant, and the light of
// skies, stars, discs and bodies is multiplied by it.
inline double exposure_scale(const FrameSettings& settings) {
  return std::exp2(settings.ev) / kReferenceLuminance;
}

// A star of magnitude 0 gives this illuminance (lux).  The number sets the size at which stars are
// drawn, and the survey turns pixel values into magnitudes by it.
inline constexpr double kMagnitudeZeroLux = 2.63e-6;

}  // namespace domefall
