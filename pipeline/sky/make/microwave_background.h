// The cosmic microwave background as a sky to look at.
#pragma once

#include "pipeline/sky/make/healpix_map.h"

namespace domefall {

inline constexpr double kCmbTemperature = 2.725;  // K; Fixsen 2009, ApJ 707, 916

// The background is a blackbody of 2.725 K, the same all over the sky to 1e-5.  As it is, nobody
// could see it or tell it from an even glow.  It is shown as it was at redshift `redshift` (at 1100
// it was set free, at 3000 K), with its fluctuations dT enlarged `contrast` times:
//
//   T = 2.725 K redshift (1 + contrast dT / 2.725 K)
//
// Its radiance, that of a blackbody, goes as T^4, and light of a frequency ratio g is seen as that
// of g T.  It is thinned by one factor, with which an even sky of the mean temperature would have
// `luminance`.
struct CmbSettings {
  double redshift = 1100, contrast = 4000;
  double luminance = 3e-4;  // cd/m^2
  double kelvin = 1;        // dT where the map has the value 1
};

// The enlarged fluctuation is cut to this part of T.  In the plane of the Milky Way it exceeds it.
inline constexpr double kCmbLargest = 0.5;

// Returns the unit (sky_unit) of a thermal map that holds the hottest place there can be.
double cmb_unit(const CmbSettings& cmb);

// Sets the finest level of a thermal map, border and all, from a map of dT in the coordinates
// `frame`.
void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbSettings& cmb,
               const SkyPyramid& pyramid);

}  // namespace domefall
