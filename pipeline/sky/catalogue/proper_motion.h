// Stars move, so that they stand at other places in other years.
#pragma once

#include "trajectories/directions.h"

namespace domefall {

// A greater proper motion (mas a year) is a mistake.  Barnard's star, the fastest, has 1.04e4.
inline constexpr double kFastest = 1e5;

// Returns the direction of a star after some Julian years, forwards or backwards.  `pm_ra` and
// `pm_dec` are its proper motion in mas a year, and the one in right ascension is multiplied by cos
// Dec.  The star moves straight on and square to the line of sight, so the result is direction +
// years * motion, made a unit vector.  That is exact for a star without radial velocity.  Barnard's
// star, which approaches at 110 km/s, is 0.2 degrees off after 1,000 years.  At a pole, where east
// is undefined, the direction counts as one of right ascension 0.
SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years);

}  // namespace domefall
