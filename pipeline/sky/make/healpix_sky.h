// Sky maps of HEALPix maps: of light, and of the cosmic microwave background.
#pragma once

#include "pipeline/sky/make/healpix_map.h"
#include "pipeline/sky/maps/orientation.h"
#include "pipeline/sky/maps/sky_pyramid.h"

namespace domefall {

// A map of light: grey (D65), `luminance` cd/m^2 for a value of 1; what is negative is dark.
double healpix_unit(const HealpixMap& map, double luminance);
void paint_healpix(const HealpixMap& map, SkyFrame frame, double luminance,
                   const SkyPyramid& pyramid);

// The microwave background is a blackbody of 2.725 K, the same all over the sky to 1e-5: as it is, it
// can be neither seen nor told from an even glow.  A sky to look at shows it as it was at redshift
// `redshift` (1100: when it was set free, at 3000 K) and with its fluctuations `contrast` times as
// large, T = 2.725 K redshift (1 + contrast dT / 2.725 K), and thinned so that an even sky of the mean
// temperature would have `luminance` cd/m^2.  It stays blackbody light: radiance goes as T^4, and a
// frequency ratio g is seen as g T.
struct CmbLook {
  double redshift = 1100, contrast = 4000, luminance = 3e-4;
  double kelvin = 1;  // of a value of 1 in the map, which holds dT
};
inline constexpr double kCmbTemperature = 2.725;  // Fixsen 2009, ApJ 707, 916
// Where contrast dT is beyond this part of T, as in the plane of the Milky Way, it is cut to it.
inline constexpr double kCmbLargest = 0.5;

double cmb_unit(const CmbLook& look);
void paint_cmb(const HealpixMap& map, SkyFrame frame, const CmbLook& look,
               const SkyPyramid& pyramid);

}  // namespace domefall
