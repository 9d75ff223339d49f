// Colours are types here, so that CIE XYZ and the scene-linear working space do not mix.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>

namespace domefall {

// These are CIE 1931 tristimulus values, with Y in the photometric unit of the context (cd/m^2 or
// lux).
struct Xyz {
  double x, y, z;
};

// A WorkingRgb is linear light with the AP1 primaries and the ACES white (ACEScg), in the same
// unit.  The luminance of (1, 1, 1) is 1.  The white of Domefall's skies is D65, so XYZ are adapted
// to the ACES white (Bradford) and a D65 light is neutral.
struct WorkingRgb {
  float r, g, b;
};

inline constexpr const char* kWorkingSpaceName = "ACEScg";

// RgbPrimaries are CIE x, y of red, green, blue and white.
struct RgbPrimaries {
  double red[2], green[2], blue[2], white[2];
};
inline constexpr RgbPrimaries kAp1{
    {0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
inline constexpr RgbPrimaries kRec709{
    {0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, {0.3127, 0.3290}};

// Matrices apply to columns: out[i] = sum over j of m[i][j] in[j].
using ColourMatrix = Imath::M33d;

ColourMatrix xyz_from_rgb(const RgbPrimaries& space);
// Takes D65-relative XYZ to the working space.
const ColourMatrix& working_from_xyz();
// Takes linear Rec.709 (sRGB primaries, D65) to the working space.
const ColourMatrix& working_from_rec709();

// Takes linear RGB to the working space.  `xy` are CIE x, y of its red, green, blue and white,
// which becomes neutral (Bradford).  A y of a primary may be 0.
ColourMatrix working_from_rgb(const std::array<double, 8>& xy);

WorkingRgb to_working(const Xyz& colour);

// Returns the colour at `saturation` times its distance from the grey of its luminance.  What would
// become negative is 0.
inline WorkingRgb saturated(const WorkingRgb& c, float luminance, float saturation) {
  const auto mixed = [=](float v) {
    const float m = luminance + saturation * (v - luminance);
    return m > 0 ? m : 0;
  };
  return {mixed(c.r), mixed(c.g), mixed(c.b)};
}

// These are what one unit of each channel of a working-space colour adds to the luminance of light.
// The three add up to 1.
const std::array<float, 3>& luminance_weights();

// Returns the luminance of a working-space colour in the scene's own (D65-relative) terms.
double luminance(const WorkingRgb& colour);

}  // namespace domefall
