// A DisplayColour says what the codes of a display mean, for other programs to read in a file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/image/encode/picture_writers.h"

namespace domefall {

struct DisplayColour {
  // kSrgb: IEC 61966-2-1, with its straight part near black.  kPq: SMPTE ST 2084.  kHlg: ITU-R
  // BT.2100's hybrid log-gamma, for a display of 1000 cd/m^2.
  enum class Curve { kPower, kSrgb, kPq, kHlg };
  Curve curve = Curve::kSrgb;
  double gamma = 2.2;          // of kPower
  std::array<double, 8> xy{};  // CIE x, y of red, green, blue and white
  bool operator==(const DisplayColour&) const = default;
};

// These are the primaries and whites of ITU-R BT.709, which sRGB shares, of BT.2020, of SMPTE RP
// 431-2 (DCI-P3), of the last with the white D65, of Adobe RGB (1998), and of the spaces AP1 (that of
// ACEScg) and AP0 of ACES (ST 2065-1).
inline constexpr std::array<double, 8> kRec709Places{0.64, 0.33, 0.3,    0.6,
                                                     0.15, 0.06, 0.3127, 0.329},
    kRec2020Places{0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.329},
    kDciP3Places{0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.314, 0.351},
    kP3D65Places{0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.329},
    kAdobeRgbPlaces{0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.329},
    kAp1Places{0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767},
    kAp0Places{0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};

// Returns the light in cd/m^2 of a code from 0 to 1, by SMPTE ST 2084.
double pq_light(double code);

// Returns the number of primaries in ITU-T H.273, to 0.001 in x and y, or 2, which is unspecified.
// Those of DCI-P3 also match with a white that was adapted to D65.
int h273_primaries(const std::array<double, 8>& xy);

inline constexpr int kH273Pq = 16, kH273Hlg = 18;  // transfer characteristics in ITU-T H.273

// Returns gAMA and cHRM, and also sRGB if the colour is that.  For PQ and HLG, which no gAMA can
// say, it returns cICP and cHRM.  Other colours have no cICP, which could say no more about them.
// Programs from before PNG's third edition (pngcheck 3) would take it for damage.
std::vector<PngChunk> png_colour_chunks(const DisplayColour& colour);

// Returns an ICC profile of a matrix and a curve, for TIFF and JPEG.  The same colour has the same
// bytes.  There is none for PQ and HLG, whose light has no relation to a paper's white.
std::string icc_profile(const DisplayColour& colour);

}  // namespace domefall
