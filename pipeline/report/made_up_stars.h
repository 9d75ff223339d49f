// A made-up sky has as many stars of each magnitude as Tycho-2.  The report measures with it what
// stars cost.
#pragma once

#include <cstddef>

#include "pipeline/sources/stars/raw_catalogue.h"

namespace domefall {

// Returns the magnitude V of the star at this rank by brightness, from 1 to kMostMadeUpStars.
// ln rank against V runs in straight lines between the counts of Tycho-2 (catalogue I/259 of the
// CDS) at V = -1.5, 6.5, 8, 9, 10, 11, 12 and 13.
double magnitude_of_rank(double rank);

inline constexpr std::size_t kMostMadeUpStars = 2'543'829;

// Returns the brightest `count` of these stars, brightest first.  They are spread evenly over the
// sphere, and their B-V evenly from -0.2 to 1.8.  They are the same in every run.  `count` is at
// most kMostMadeUpStars.
RawCatalogue made_up_stars(std::size_t count);

}  // namespace domefall
