// A DiscPattern says what its patterns make of a disc's light.  It is a factor on the radiance, by
// place and time of emission.  On every ring r = const the mean of the factor is 1 at each time,
// exactly, for filaments and spots, alone and together.  Rings have a mean of 1 over their spacing.  The factor is a
// smooth function of place and time, the same on every machine, and never below 0.  What is finer
// than a footprint fades into the mean, so that a picture neither aliases nor shimmers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/sources/disc/pattern_map.h"

namespace domefall {

// A PatternPlace is a place on the disc as a pixel sees it.
struct PatternPlace {
  double r;        // M, from the horizon on
  double azimuth;  // radians from the node, in the sense of the orbits
  double time;     // t at emission, M; |t| < 1e15
  // A pixel covers these spans from edge to edge.  One is of r (M).  The other is of the azimuth
  // among the gas (radians), which also changes with the time of emission.  Both are >= 0.
  double r_width = 0, azimuth_width = 0;
};

// Turbulence makes the filaments in a disc's gas.  It is a noise of all sizes (NoiseTile) that turns
// with the gas.  The orbits further in are the faster ones and so draw it out into spirals, and it is
// replaced as it ages.
//
// The disc is divided into rows of equal width in ln r, which fade into each other from one's middle to
// the next.  In each row two generations live at a time, each with the noise at a place that a hash
// chooses: one fades in while the other fades out.  All weights add up to 1.
class Turbulence {
 public:
  Turbulence(const TurbulencePattern& pattern, const GasOrbits& orbits);

  // Finds the factor at each place, for r <= 1e6.
  void factors(std::span<const PatternPlace> places, std::span<float> out) const;

 private:
  TurbulencePattern pattern_;
  GasOrbits orbits_;
  // This is the time (M) from one generation of a row to the next, for the rows from r = 1 on, and its
  // inverse.
  std::vector<double> spans_, rates_;
};

class DiscPattern {
 public:
  // Throws as PatternMap where there is a map.
  explicit DiscPattern(std::span<const PatternKind> kinds, const GasOrbits& orbits = GasOrbits());

  // Turbulence, rings and a map multiply each other.  Spots add their light, as parts of even gas, and the
  // sum is divided by its mean around the ring.

  void factors(std::span<const PatternPlace> places, std::span<float> out) const;

 private:
  GasOrbits orbits_;
  std::optional<Turbulence> turbulence_;
  std::optional<RingPattern> rings_;
  std::vector<SpotPattern> spots_;
  std::optional<PatternMap> map_;
  double map_at_ = 0;
};

}  // namespace domefall
