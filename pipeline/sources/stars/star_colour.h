// Catalogue files hold the colours of stars.  The temperature with which a star is drawn follows
// from its colour.
#pragma once

#include <string_view>

namespace domefall {

// A colour is one number: B-V (magnitudes) from kBluest to kReddest, a temperature (K) from
// kColdest to kHottest, or kNoColour where a catalogue gives neither.  The three ranges do not
// overlap.
inline constexpr float kBluest = -2, kReddest = 10;
inline constexpr float kColdest = 500, kHottest = 1e6F;
inline constexpr float kNoColour = 99;

// A star that has no colour is drawn with this B-V, which is near the median of naked-eye stars.
inline constexpr double kAssumedColour = 0.6;

inline bool is_temperature(float colour) { return colour >= kColdest; }

// Returns B-V as a colour.  A value beyond the range of B-V becomes the nearest in it.
float colour_of_b_v(double b_v);

// Returns the effective temperature (K) for B-V by Ballesteros 2012 (EPL 97, 34008), who takes
// stars for blackbodies.  B-V is limited to -0.4 to kReddest, so the result lies between 890 K and
// 22,000 K.  Carbon stars (B-V of 3 to 5) are warmer than the result, but as red as it.
double temperature_from_b_v(double b_v);

// Returns the temperature (K) of the blackbody that a star of this colour is drawn as.
double temperature_of(float colour);

// Returns the colour of a spectral type of the Henry Draper Catalogue, which is a
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
