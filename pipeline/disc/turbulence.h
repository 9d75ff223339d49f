// Turbulence makes the filaments in a disc's gas.  It is a noise whose grains turn with the gas.
// The orbits further in are the faster ones and so draw the grains out into spirals.  Grains are
// replaced as they age.
//
// Grains of three sizes lie in rows of equal width in ln r, in places that a hash of row and
// generation chooses.  Rows, and the generations of a row, are joined by quadratic B-splines, which
// add up to 1.  The light of a row's grains has a fixed mean around the ring, whatever the shear
// and the footprint do, because a footprint makes a grain wider and keeps its light.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/disc/disc.h"

namespace domefall {

// A PatternPlace is a place on the disc as a pixel sees it.
struct PatternPlace {
  double r;        // M, >= 2
  double azimuth;  // radians from the node, in the sense of the orbits
  double time;     // t at emission, M; |t| < 1e15
  // A pixel covers these spans from edge to edge.  One is of r (M).  The other is of the azimuth
  // among the gas (radians), which also changes with the time of emission.  Both are >= 0.
  double r_width = 0, azimuth_width = 0;
};

class Turbulence {
 public:
  explicit Turbulence(const TurbulencePattern& pattern);

  // Finds the factor at each place, for r <= 1e6.
  void factors(std::span<const PatternPlace> places, std::span<float> out) const;

  static constexpr int kSizes = 3;

 private:
  TurbulencePattern pattern_;
  // This is the time (M) from one generation of a row to the next, for the rows of each size from
  // r = 1 on, and its inverse.
  std::array<std::vector<double>, kSizes> spans_, rates_;
};

}  // namespace domefall
