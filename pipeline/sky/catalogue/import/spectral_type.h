// A star of which only the spectral type is known gets its colour from that.
#pragma once

#include <string_view>

namespace domefall {

// Returns the colour (star_colour.h) of a spectral type of the Henry Draper Catalogue, which is a
// letter and perhaps a digit ("K0", "B8p", "Oe5", "Ma").  Returns kNoColour for blank and peculiar
// types ("Pec", "Con").
//
// - The colour of O and B is a temperature in kelvin, that of dwarfs by Pecaut & Mamajek 2013 (ApJS
//   208, 9; table of 2024): O5 41,400, B0 31,400, B5 15,700, A0 9,700.  Its logarithm is linear
//   between them.  Observed colours would tell too little, because dust reddens the light of these
//   distant stars.
// - The colour of A to M is the observed B-V.  It is the median over each type of the Hipparcos
//   stars of V < 9 in Stellarium 0.22 (48,000 with a subtype): A0 0.07, A5 0.26, F0 0.35, F5 0.48,
//   G0 0.60, G5 0.89, K0 1.07, K2 1.30, K5 1.55, M0 1.64.  It is linear between them.  From K on
//   these stars are giants, as most stars are that are bright enough for that catalogue.  Beyond M0
//   the value of M0 is kept: bands of TiO make B-V smaller again although the stars are cooler.
// - The colours of S, 1.8, and of N (carbon stars), 2.4, are medians of the same stars.  R is taken
//   as K5.
float colour_of_spectral_type(std::string_view type);

}  // namespace domefall
