// What a view ray of the past singularity's light needs besides its azimuth: a bound on how fast
// that changes, and when the light started.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/optics/hole_optics.h"

namespace domefall {

// Bounds |d phi/d alpha|.  Near the axis phi grows like the cube root of alpha, so its slope is
// infinite on the axis, and no image of any size resolves a slope beyond this.
inline constexpr double kSteepestSlope = 1e9;

inline double bounded_slope(const WhiteHoleTable& table, const WhiteHoleTable::Place& place) {
  return std::min(std::abs(table.slope(place)), kSteepestSlope);
}

// The time at which light started from the singularity, with its derivative by alpha, for a ray
// with half of alpha, its azimuth and its bounded slope.  Both tables must exist.
inline EmissionTimeTable::Value emission_of(const HoleOptics& optics, const HalfAngle& half,
                                            double azimuth, double slope) {
  const WhiteHoleTable::Place place = optics.white_hole->place_of(half.sine, half.cosine);
  const bool beyond = half.sine > optics.white_hole->lookup().place.zero * half.cosine;
  return optics.emission_times->at(place, beyond, azimuth, slope);
}

}  // namespace domefall
