// A DiscPattern says what a pattern makes of a disc's light.  It is a factor on the radiance, by
// place and time of emission.  On every ring r = const the mean of the factor is 1 at each time,
// exactly, for filaments and the spot.  Rings have a mean of 1 over their spacing.  The factor is a
// smooth function of place and time, the same on every machine, and never below 0.  What is finer
// than a footprint fades into the mean, so that a picture neither aliases nor shimmers.
#pragma once

#include "pipeline/disc/disc.h"
#include "pipeline/disc/turbulence.h"

namespace domefall {

// Returns the angular velocity of a disc's gas per M of t, for r >= 2 (M).  It is r^(-3/2) on
// circular orbits, and that of the plunge inside the last stable one.
double angular_velocity(double r);
// The law of the plunge is (1 - 2/r) L'/E'/r^2 with this L'/E'.
inline constexpr double kPlungeTurning = 3.674234614174767;  // sqrt 13.5

class DiscPattern {
 public:
  explicit DiscPattern(const PatternKind& kind);

  // Finds the factor at each place.
  void factors(std::span<const PatternPlace> places, std::span<float> out) const;

 private:
  PatternKind kind_;
  std::optional<Turbulence> turbulence_;
};

}  // namespace domefall
