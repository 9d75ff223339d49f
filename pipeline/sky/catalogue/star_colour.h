// Catalogue files hold the colours of stars.  The temperature with which a star is drawn follows
// from its colour.
#pragma once

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

}  // namespace domefall
