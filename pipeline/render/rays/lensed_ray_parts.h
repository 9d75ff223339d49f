// What one bent look and many at a time have in common.
#pragma once

#include <cmath>

#include "pipeline/optics/hole_optics.h"

namespace domefall {

// Sine and cosine of delta/2 from those of delta, without cancellation.
struct HalfAngle {
  double sine, cosine;
};
inline HalfAngle half_angle(double cos_delta, double sin_delta) {
  const double larger = std::sqrt((1 + std::abs(cos_delta)) / 2);
  const double smaller = sin_delta / (2 * larger);
  return cos_delta >= 0 ? HalfAngle{smaller, larger} : HalfAngle{larger, smaller};
}

// On the axis the azimuth of the singularity's light changes like the cube root of the angle: faster
// than any picture can show.
inline constexpr double kSteepest = 1e9;

// Of light of the singularity, if its times are tabulated.
inline EmissionTimeTable::Value emission_of(const HoleOptics& optics, double sin_half,
                                            double cos_half, double azimuth, double slope) {
  const WhiteHoleTable::Place place = optics.white_hole->place_of(sin_half, cos_half);
  const bool beyond = sin_half > optics.white_hole->lookup().place.zero * cos_half;
  return optics.emission_times->at(place, beyond, azimuth, slope);
}

}  // namespace domefall
