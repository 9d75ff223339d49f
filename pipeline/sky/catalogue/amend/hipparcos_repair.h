// Magnitudes and colours of Hipparcos laid over a catalogue whose stars bear Hipparcos numbers.
#pragma once

#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

// These count the stars that a repair changed or added.
struct HipparcosRepair {
  std::size_t stars = 0;    // took V from Hipparcos
  std::size_t colours = 0;  // had no colour and took that of Hipparcos
  std::size_t added = 0;    // were not in the catalogue
};

// - A star that is alone with its number takes V from Hipparcos and, where Hipparcos has one, its
//   colour.
// - Where several stars share a number, V of Hipparcos is that of their light together.  Each keeps
//   its own V.  Only where all are rough, they are shifted together so that their sum has V of
//   Hipparcos.  Those without a colour take that of the pair.
// - Stars of Hipparcos that the catalogue does not have are added.
//
// Measured over 1,733 pairs of Tycho-2 that differ by less than a magnitude: V of Hipparcos less V
// of the sum has the median 0.015, and 80 % lie between -0.05 and 0.08; less V of the brighter star
// it has the median -0.56.
HipparcosRepair repair_by_hipparcos(RawCatalogue& catalogue, const RawCatalogue& hipparcos);

}  // namespace domefall
