// Computes how much of a star's catalogued light a frame shows.
#pragma once

#include <algorithm>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Stars fade in over this many magnitudes before a limit that is keyframed.
inline constexpr double kFadeMagnitudes = 0.5;

// Returns the part of a star's light that the frame's limit of magnitude leaves.  Magnitudes are
// floats.  A hard limit is rounded as they were, so that no star on the limit is lost.
inline double part_within_limit(const FrameSettings::Sky& sky, double magnitude) {
  if (!sky.soft_limit) return magnitude <= double{static_cast<float>(sky.max_magnitude)} ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFadeMagnitudes, 0.0, 1.0);
}

// Returns the flux of an image of a star.  `amplification` is that of the image in the tetrad, and
// `doppler` is the frequency ratio of the boost to the observer, who sees g times the emitted
// frequency.  The boost divides solid angles by doppler^2, so the observer's amplification is f =
// amplification/doppler^2.  By [Riazuelo] sec. sec_stars_eff the bolometric magnitude of the image
// is m + 10 log10(1+z) - 2.5 log10(f).
inline double received_flux(const Effects& effects, double flux, double amplification,
                            double doppler, double g) {
  if (effects.amplification != Amplification::kNone) flux *= amplification / (doppler * doppler);
  if (effects.intensity) flux = flux * g * g * g * g;
  return flux;
}

}  // namespace domefall
