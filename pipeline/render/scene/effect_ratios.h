// Computes how light of frequency ratio g = observed/emitted changes where a show leaves some
// effects out.  In nature a blackbody of temperature T is seen as one of g T, whose bolometric
// intensity is g^4 times the emitted one ([Riazuelo] app. app_img).
#pragma once

#include <algorithm>

#include "pipeline/show/show.h"

namespace domefall {

// No light is brighter than this, which is far beyond what a frame holds and well within a float.
inline constexpr double kSaturated = 1e25;

// Returns the factor from the emitted to the observed temperature.
inline double colour_ratio(const Effects& effects, double g) {
  return effects.doppler_colour ? g : 1;
}

// Returns the factor to the light of a blackbody surface at the observed temperature, whose
// intensity is proportional to colour_ratio^4 already.  It is at most kSaturated.  Where this cuts
// off a large 1/g^4, the light is too red to be seen at all.
inline double surface_brightness_ratio(const Effects& effects, double g) {
  if (effects.doppler_colour == effects.intensity) return 1;
  const double g4 = g * g * g * g;
  return std::min(effects.intensity ? g4 : 1 / g4, kSaturated);
}

}  // namespace domefall
