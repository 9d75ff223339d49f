// Computes what a view ray of the past singularity's light needs besides its azimuth: the rate at
// which the azimuth changes, with a bound, and the time at which the light started.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/light/hole_optics.h"

namespace domefall {

// This bounds |d phi/d alpha|.  Near the axis phi grows like the cube root of alpha, so its slope
// is infinite on the axis.  No image of any size resolves a slope beyond the bound.
inline constexpr double kSteepestSlope = 1e9;

inline double bounded_slope(const WhiteHoleTable& table, const WhiteHoleTable::Place& place) {
  return std::min(std::abs(table.slope(place)), kSteepestSlope);
}

// Returns the time at which the light of a ray started from the singularity, and the derivative of
// this time by alpha.  The ray is given by half of its alpha, its azimuth and its bounded slope.
// The tables of the white hole and of the emission times must exist.
inline EmissionTimeTable::Value emission_of(const HoleOptics& optics, const HalfAngle& half,
                                            double azimuth, double slope) {
  const WhiteHoleTable::Place place = optics.white_hole->place_of(half.sine, half.cosine);
  // The energy E of the ray is positive where tan(alpha/2) exceeds the T_0 of white_hole_table.h.
  const bool beyond = half.sine > optics.white_hole->lookup().place.zero * half.cosine;
  return optics.emission_times->at(place, beyond, azimuth, slope);
}

}  // namespace domefall
