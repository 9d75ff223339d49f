// A sky of stars as many of each magnitude as Tycho-2 has, for measuring what they cost.
#pragma once

#include <cstddef>

#include "pipeline/sky/catalogue/star_record.h"

namespace domefall {

// V of the star so many are as bright as or brighter than; rank from 1 to kMostMadeUpStars.  ln
// rank against V in straight lines between what Tycho-2 (I/259) counts at -1.5, 6.5, 8, 9, 10, 11,
// 12 and 13.
double magnitude_of_rank(double rank);

inline constexpr std::size_t kMostMadeUpStars = 2'543'829;

// The brightest `count` of them, brightest first, spread evenly over the sphere, B-V evenly from
// -0.2 to 1.8.  The same ones in every run.  count at most kMostMadeUpStars.
RawCatalogue made_up_stars(std::size_t count);

}  // namespace domefall
