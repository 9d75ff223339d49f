// A repair lays the magnitudes and colours of Hipparcos over a catalogue whose stars bear Hipparcos
// numbers.
#pragma once

#include "pipeline/sky/catalogue/raw_catalogue.h"

namespace domefall {

// These numbers count the stars that a repair changed or added.
struct HipparcosRepair {
  std::size_t stars = 0;    // took V from Hipparcos
  std::size_t colours = 0;  // had no colour and took that of Hipparcos
  std::size_t added = 0;    // were not in the catalogue
};

// Repairs the magnitudes and colours of a catalogue by those of Hipparcos.
//
// - A star that is alone with its number takes V from Hipparcos and, where Hipparcos has one, its
//   colour.
// - Where several stars share a number, V of Hipparcos is that of their light together.  Each star
//   keeps its own V, unless all are rough.  In that case they are shifted together so that their
//   sum has V of Hipparcos.  Stars without a colour take that of Hipparcos.
// - Stars of Hipparcos that the catalogue does not have are added.
//
// The difference between V of Hipparcos and V of the sum was measured over 1,733 pairs of Tycho-2
// whose magnitudes differ by less than 1.  Its median is 0.015, and 80 % of the differences lie
// between -0.05 and 0.08.  Against V of the brighter star alone the median is -0.56.
HipparcosRepair repair_by_hipparcos(RawCatalogue& catalogue, const RawCatalogue& hipparcos);

}  // namespace domefall
