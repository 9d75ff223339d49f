// Right ascension and declination are those of J2000, in degrees as people write them.
#pragma once

#include "trajectories/directions.h"

namespace domefall {

struct Equatorial {
  double ra_deg, dec_deg;  // 0 to 360, -90 to 90
};

// Takes any right ascension, whole turns included, and a declination from -90 to 90.
SkyDirection sky_direction(double ra_deg, double dec_deg);

// At a pole the right ascension is 0 or, where rounding has left something of x and y, anything.
Equatorial equatorial(const SkyDirection& direction);

}  // namespace domefall
