// HEALPix maps are sampled between their pixels, and the skies that they hold are painted from
// them.
#pragma once

#include "pipeline/image/read_healpix.h"
#include "pipeline/sky/maps/orientation.h"
#include "pipeline/sky/maps/sky_pyramid.h"

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

// Returns the number of samples along the side of a texel.  A level that is coarser than the map
// takes several, whose mean is the texel.
int samples_across(const HealpixMap& map, const SkyPyramid::Level& level);

// Returns the rotation of equatorial directions into the coordinates of a frame.
M33d frame_from_equatorial(SkyFrame frame);

// Returns the unit (sky_unit) of a colour map of grey light (D65) in which the value 1 stands for
// `luminance` cd/m^2.
double healpix_unit(const HealpixMap& map, double luminance);

// Sets the finest level of such a colour map, including its border.  Negative values become dark.
void paint_healpix(const HealpixMap& map, SkyFrame frame, double luminance,
                   const SkyPyramid& pyramid);

}  // namespace domefall
