// The orientation of a sky map says how the panorama that it was made from lies on the sky.
#pragma once

#include <string>

#include "trajectories/directions.h"

namespace domefall {

enum class SkyFrame { kEquatorial, kGalactic };  // J2000; IAU 1958 poles

// This is the orientation of an equirectangular panorama as one looks at it.  Longitude is right
// ascension or galactic longitude, and latitude is declination or galactic latitude.
struct Orientation {
  SkyFrame frame = SkyFrame::kEquatorial;
  // Seen from inside, as the sky is, longitude grows to the left.
  bool longitude_right = false;
  bool south_up = false;
  double centre_deg = 0;  // longitude of the middle column

  bool operator==(const Orientation&) const = default;
};

// Returns a text such as "equatorial, RA 270 deg in the middle, growing to the left, north up".
std::string orientation_phrase(const Orientation& orientation);

// Returns the matrix that turns an equatorial direction into the panorama's own space, in which the
// panorama's middle is +x, its left quarter +y and its top +z.  The matrix is a rotation or, where
// the panorama is mirrored, a reflection, so its inverse is its transpose.
M33d panorama_from_equatorial(const Orientation& orientation);

// Returns the rotation from equatorial J2000 to galactic axes, with x to the galactic centre and z
// to the north pole.  It is eq. 1.5.11 of the Hipparcos catalogue, vol. 1, accurate to 0.4 mas.
M33d galactic_from_equatorial();

}  // namespace domefall
