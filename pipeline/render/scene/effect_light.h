// What the effects that a show leaves out do to light of frequency ratio g = observed/emitted.
// [Riazuelo] app. app_img: a blackbody is seen at g T, its bolometric intensity changes by g^4.
#pragma once

#include <algorithm>

#include "pipeline/show/show.h"

namespace domefall {

// Far beyond what a picture holds and well within a float: light is saturated there.
inline constexpr double kSaturated = 1e25;

// By what temperatures are multiplied.
inline double colour_ratio(const Effects& effects, double g) {
  return effects.doppler_colour ? g : 1;
}

// By what a blackbody surface at that temperature is multiplied besides, since it brings an intensity
// that goes with colour_ratio^4 already; at most kSaturated.  (Where that bounds a large 1/g^4, the
// light is too red to be seen at all.)
inline double surface_brightness_ratio(const Effects& effects, double g) {
  if (effects.doppler_colour == effects.intensity) return 1;
  const double g4 = g * g * g * g;
  return std::min(effects.intensity ? g4 : 1 / g4, kSaturated);
}

}  // namespace domefall
