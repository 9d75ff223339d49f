// HEALPix maps are sampled between their pixels, and skies are painted from them: as they are, or as
// the cosmic microwave background.
#pragma once

#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/orientation.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {

class HealpixMap {
 public:
  // Bad pixels, which are NaN, get the value `missing`.
  HealpixMap(HealpixFile file, float missing);

  // Returns the value in a direction, of any length, in the map's own coordinates.  It is linear
  // between the two nearest pixels of each of the two nearest rings (Gorski et al. 2005, sec. 5.1),
  // and linear in colatitude between the rings.  A pole has the mean of its four pixels.
  double at(const V3d& direction) const;

  int nside() const { return file_.nside; }
  const std::vector<float>& values() const { return file_.values; }  // in RING order

 private:
  struct Ring {
    long first, count;  // pixels
    double theta;       // colatitude
    double shift;       // longitude of the first pixel's centre, in pixels
  };
  Ring ring(long number) const;  // from 1 at the north to 4 nside - 1
  long ring_above(double z, double across) const;
  double pole(std::size_t first) const;
  double on_ring(const Ring& ring, double phi) const;

  HealpixFile file_;  // in RING order
};

// Returns the number in RING order of a pixel in NESTED order.
long ring_from_nested(int nside, long pixel);

// Returns the number of texels along a cube face that keep a map's detail, at most 4096.
int healpix_face(int nside);

// Returns the unit (sky_unit) of a colour map of grey light (D65) in which the value 1 stands for
// `luminance` cd/m^2.
double healpix_unit(const HealpixMap& map, double luminance);

// Sets the finest level of such a colour map, including its border.  Negative values become dark.
void paint_healpix(const HealpixMap& map, SkyFrame frame, double luminance,
                   const SkyPyramid& pyramid);

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
