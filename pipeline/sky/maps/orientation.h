// How the picture that a sky map was made from lies on the sky.
#pragma once

#include <string>

#include "trajectories/directions.h"

namespace domefall {

enum class SkyFrame { kEquatorial, kGalactic };  // J2000; IAU 1958 poles

// Of an equirectangular picture as one looks at it.  Longitude is right ascension or galactic
// longitude, latitude is declination or galactic latitude.
struct Orientation {
  SkyFrame frame = SkyFrame::kEquatorial;
  // Seen from inside, as the sky is, longitude grows to the left.
  bool longitude_right = false;
  bool south_up = false;
  double centre_deg = 0;  // longitude of the middle column

  bool operator==(const Orientation&) const = default;
};

// "equatorial, RA 270 in the middle, growing to the left, north up".
std::string orientation_phrase(const Orientation& orientation);

// Turns an equatorial direction into one of the picture's own space, in which the middle of an
// equirectangular picture is +x, its left quarter +y and its top +z.  A rotation or, where the
// picture is mirrored, a reflection: the inverse is the transpose.
M33d panorama_from_equatorial(const Orientation& orientation);

// Rotation from equatorial J2000 to galactic axes (x to the galactic centre, z to the north pole);
// Hipparcos catalogue, vol. 1, eq. 1.5.11: to 0.4 mas.
M33d galactic_from_equatorial();

}  // namespace domefall
