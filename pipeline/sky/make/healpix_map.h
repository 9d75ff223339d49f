// Looks into HEALPix maps, straight between pixels.
#pragma once

#include "pipeline/image/read_healpix.h"
#include "trajectories/directions.h"

namespace domefall {

class HealpixMap {
 public:
  // Bad pixels become `missing`.
  HealpixMap(HealpixFile file, float missing);

  // Straight between the two nearest pixels of each of the two nearest rings (Gorski et al. 2005,
  // sec. 5.1 for the rings), in the map's own coordinates; a pole is the mean of its four pixels.
  double at(const V3d& direction) const;

  int nside() const { return file_.nside; }
  const std::vector<float>& values() const { return file_.values; }

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

// The number in RING order of a pixel in NESTED order.
long ring_from_nested(int nside, long pixel);

// Texels along a cube face that keep a map's detail.
int healpix_face(int nside);

}  // namespace domefall
