// Colours of stars of which only a spectral type is known.
#pragma once

#include <string_view>

namespace domefall {

// Colour (star_record.h) of a type of the Henry Draper Catalogue: a letter and perhaps a digit ("K0", "B8p",
// "Oe5", "Ma").  kNoColour for blank and peculiar ones ("Pec", "Con").
//
// - O and B: a temperature in kelvin, that of dwarfs by Pecaut & Mamajek 2013 (ApJS 208, 9; table of 2024), O5
//   41,400, B0 31,400, B5 15,700, A0 9,700, its logarithm linear between them.  Their light is reddened
//   by dust, so that observed colours would tell too little.
// - A to M: B-V observed, the medians over types of the Hipparcos stars of V < 9 in Stellarium 0.22 (48,000
//   with a subtype): A0 0.07, A5 0.26, F0 0.35, F5 0.48, G0 0.60, G5 0.89, K0 1.07, K2 1.30, K5 1.55,
//   M0 1.64, linear between them.  From K on they are giants, as most stars are that are bright enough for
//   that catalogue.  Beyond M0 the bands of TiO make B-V smaller again while stars are cooler: 1.64 is
//   kept.
// - S 1.8 and N (carbon stars) 2.4, medians of the same; R as K5.
float colour_of_spectral_type(std::string_view type);

}  // namespace domefall
