// How much of a star's catalogued light a frame shows.
#pragma once

#include <algorithm>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Stars fade in over so many magnitudes before a limit that is keyframed.
inline constexpr double kFadeMagnitudes = 0.5;

// The part of a star's light that the frame's limit of magnitude leaves.  Magnitudes are floats, so
// a hard limit is rounded as they were, lest a star on the limit be lost.
inline double part_within_limit(const FrameSettings::Sky& sky, double magnitude) {
  if (!sky.soft_limit) return magnitude <= double{static_cast<float>(sky.max_magnitude)} ? 1 : 0;
  return std::clamp((sky.max_magnitude - magnitude) / kFadeMagnitudes, 0.0, 1.0);
}

// The flux of an image of a star.  `amplification` is that of the image in the tetrad, `doppler`
// the frequency ratio of the boost to the observer, who sees g times the emitted frequency.  By
// [Riazuelo] sec. sec_stars_eff its magnitude is m + 10 log10(1+z) - 2.5 log10(f), with the
// amplification f.
inline double received_flux(const Effects& effects, double flux, double amplification,
                            double doppler, double g) {
  if (effects.amplification != Amplification::kNone) flux *= amplification / (doppler * doppler);
  if (effects.intensity) flux = flux * g * g * g * g;
  return flux;
}

}  // namespace domefall
