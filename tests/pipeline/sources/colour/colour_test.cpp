#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/colour/cie1931.h"

namespace domefall {
namespace {

struct Xy {
  double x, y;
};
Xy chromaticity(const Xyz& c) { return {c.x / (c.x + c.y + c.z), c.y / (c.x + c.y + c.z)}; }

// CIE 015: the 1 nm table sums to 106.865, 106.857, 106.892; the 5 nm one to a fifth of that.
TEST(Cie1931, TheThreeFunctionsHaveEqualArea) {
  double sum[3] = {};
  for (const auto& row : kCie1931)
    for (int k = 0; k < 3; ++k) sum[k] += row[static_cast<std::size_t>(k)] * kCieStepNm;
  EXPECT_NEAR(sum[0], 106.865, 0.01);
  EXPECT_NEAR(sum[1], 106.857, 0.01);
  EXPECT_NEAR(sum[2], 106.892, 0.01);
}

// Illuminant A is a 2856 K blackbody with c2 = 1.4388e-2: x, y = 0.44757, 0.40745.
TEST(Blackbody, IlluminantAHasItsChromaticity) {
  const Xy a = chromaticity(blackbody_xyz(2855.5));
  EXPECT_NEAR(a.x, 0.44757, 1e-4);
  EXPECT_NEAR(a.y, 0.40745, 1e-4);
}

TEST(Blackbody, InfinitelyHotLightHasTheLimitingColour) {
  const Xy limit = chromaticity(blackbody_xyz(1e9));
  EXPECT_NEAR(limit.x, 0.23988, 1e-4);
  EXPECT_NEAR(limit.y, 0.23404, 1e-4);
}

// IAU 2015: m_bol = 0 is 2.518021002e-8 W/m^2; the bolometric correction of a 5772 K blackbody is
// -0.137.
TEST(Blackbody, TheSunsBolometricCorrectionIsABlackbodys) {
  const double bc = -2.5 * std::log10(bolometric_flux_at_v_zero(5772) / 2.518021002e-8);
  EXPECT_NEAR(bc, -0.137, 0.003);
}

// A star of V = 0 gives 2.6e-6 lux nearly whatever its colour.
TEST(Blackbody, AStarOfMagnitudeZeroGivesItsIlluminance) {
  for (double t : {3000.0, 5772.0, 10000.0}) {
    const double lux = luminance(blackbody_colours().per_flux(t)) * bolometric_flux_at_v_zero(t);
    EXPECT_NEAR(lux, 2.65e-6, 0.2e-6) << t;
  }
}

TEST(BlackbodyColours, TheTableFollowsTheIntegral) {
  for (double t = 700; t < 5e7; t *= 1.37) {
    const double exact = blackbody_xyz(t).y;
    EXPECT_NEAR(luminance(blackbody_colours().surface(t)), exact, 5e-4 * exact) << t;
  }
}

TEST(BlackbodyColours, HotterIsBrighterInEveryChannel) {
  WorkingRgb before = blackbody_colours().surface(400);
  for (double t = 410; t < 1e12; t *= 1.02) {
    const WorkingRgb now = blackbody_colours().surface(t);
    EXPECT_GE(now.r, before.r) << t;
    EXPECT_GE(now.g, before.g) << t;
    EXPECT_GE(now.b, before.b) << t;
    before = now;
  }
}

TEST(WorkingSpace, DaylightWhiteIsNeutral) {
  const double x = kRec709.white[0], y = kRec709.white[1];
  const WorkingRgb white = to_working({x / y, 1, (1 - x - y) / y});
  EXPECT_NEAR(white.r, 1, 1e-6);
  EXPECT_NEAR(white.g, 1, 1e-6);
  EXPECT_NEAR(white.b, 1, 1e-6);
}

// The matrix that OpenColorIO and every ACES table give for linear sRGB to ACEScg.
TEST(WorkingSpace, Rec709ConvertsAsInAces) {
  const ColourMatrix& m = working_from_rec709();
  const double expected[3][3] = {
      {0.6131, 0.3395, 0.0474}, {0.0702, 0.9164, 0.0134}, {0.0206, 0.1096, 0.8698}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(m[i][j], expected[i][j], 1e-4);
}

// Of primaries that a picture states.  Those of CIE XYZ have a y of 0.
TEST(WorkingSpace, WhiteOfAnyPrimariesIsWhite) {
  const std::array<double, 8> aces_cg{0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767},
      aces{0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767},
      dci{0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.314, 0.351},
      xyz{1, 0, 0, 1, 0, 0, 1 / 3.0, 1 / 3.0},
      rec709{0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329};
  for (const auto& xy : {aces_cg, aces, dci, xyz, rec709}) {
    const ColourMatrix m = working_from_rgb(xy);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(m[k][0] + m[k][1] + m[k][2], 1, 1e-14);
  }
  const ColourMatrix own = working_from_rgb(aces_cg);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(own[i][j], i == j ? 1 : 0, 1e-14);
  EXPECT_EQ(working_from_rgb(rec709), working_from_rec709());
  // The red of ACES2065-1 in ACEScg (Academy S-2014-004, the inverse of TRA_1).
  const ColourMatrix of_aces = working_from_rgb(aces);
  EXPECT_NEAR(of_aces[0][0], 1.4514393161, 1e-9);
  EXPECT_NEAR(of_aces[1][0], -0.0765537734, 1e-9);
  EXPECT_NEAR(of_aces[2][0], 0.0083161484, 1e-9);
}

}  // namespace
}  // namespace domefall
