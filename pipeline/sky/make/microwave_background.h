// The cosmic microwave background becomes a sky to look at.
#pragma once

#include "pipeline/sky/make/healpix_map.h"

namespace domefall {

inline constexpr double kCmbTemperature = 2.725;  // K; Fixsen 2009, ApJ 707, 916

// The background is a blackbody of 2.725 K, the same all over the sky to 1e-5.  As it is, nobody
// could see it or tell it from an even glow.  It is shown as it was at redshift `redshift` (it was
// set free at 1100, when it had 3000 K), with its fluctuations dT enlarged `contrast` times:
//
//   T = 2.725 K redshift (1 + contrast dT / 2.725 K)
//
// The radiance of this blackbody goes as T^4, and at a frequency ratio g it is seen as a blackbody
// of g T.  The radiance is multiplied by one factor for the whole sky, with which an even sky of
// the mean temperature would have `luminance`.
struct CmbSettings {
  double redshift = 1100, contrast = 4000;
  double luminance = 3e-4;  // cd/m^2
  double kelvin = 1;        // dT where the map has the value 1
};

// The enlarged fluctuation is cut to this part of T, which it exceeds in the plane of the Milky
// Way.
inline constexpr double kCmbLargest = 0.5;

// Returns the unit (sky_unit) of a thermal map that can hold the hottest place.
double cmb_unit(const CmbSettings& cmb);

// Sets the finest level of a thermal map, including its border, from a map of dT in the coordinates
// `frame`.
void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbSettings& cmb,
               const SkyPyramid& pyramid);

}  // namespace domefall
