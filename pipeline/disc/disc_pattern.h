// What a pattern makes of a disc's light: a factor on its radiance, by place and time of emission.
//
// On every ring r = const the mean of the factor is 1 at each time, exactly, for filaments and the
// spot; rings have a mean of 1 over their spacing.  It is a smooth function of place and time, the
// same on every machine, and never below 0.  What is finer than a footprint fades into the mean, so
// that a picture neither aliases nor shimmers.
#pragma once

#include "pipeline/disc/disc.h"
#include "pipeline/disc/turbulence.h"

namespace domefall {

// The angular velocity of a disc's gas, per M of t: r^(-3/2) on circular orbits, and that of the
// plunge inside the last stable one.  r >= 2 (M).
double angular_velocity(double r);
// That law of the plunge is (1 - 2/r) L'/E'/r^2 with this L'/E'.
inline constexpr double kPlungeTurning = 3.674234614174767;  // sqrt 13.5

class DiscPattern {
 public:
  explicit DiscPattern(const PatternKind& kind);

  // The factor at each place.
  void factors(std::span<const PatternPlace> places, std::span<float> out) const;

 private:
  PatternKind kind_;
  std::optional<Turbulence> turbulence_;
};

}  // namespace domefall
