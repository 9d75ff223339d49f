#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/colour/blackbody.h"
#include "pipeline/colour/cie1931.h"

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

}  // namespace
}  // namespace domefall
