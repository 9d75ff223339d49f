// The shipped configuration, view by view and display by display, against formulas of the
// standards and of its own comments, and against another program's reading of it.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pipeline/sources/colour/colour_space.h"
#include "tests/pipeline/grade/shipped_grade.h"

namespace domefall {
namespace {

TEST(DomeConfig, IsSoundToOpenColorIOsOwnChecker) {
  if (std::system("command -v ociocheck >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "opencolorio-tools is not installed";
  const std::string check = "ociocheck --iconfig '" + kConfig + "' 2>&1";
  FILE* pipe = popen(check.c_str(), "r");
  ASSERT_TRUE(pipe);
  std::string talk;
  for (int c; (c = std::fgetc(pipe)) != EOF;) talk += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << talk;
  EXPECT_THAT(talk, testing::HasSubstr("** Validation **\npassed"));
  EXPECT_THAT(talk, testing::HasSubstr("Default Display: Dome G2.2 Rec.709\nDefault View: Dome\n"));
  EXPECT_THAT(talk, testing::Not(testing::HasSubstr("ERROR")));
}

TEST(DomeConfig, EveryDisplayHasEveryView) {
  for (const char* display : kDisplays)
    for (const char* view : kViews) {
      const Grader grader(settings(view, display));
      EXPECT_EQ(grader.display(), display);
      EXPECT_EQ(grader.view(), view);
    }
}

// ACES alone lifts black: its 0.02 cd/m^2 is 1 in 65535 here.
TEST(DomeConfig, BlackIsCodeValueZeroButInAces) {
  for (const char* display : kDisplays)
    for (const char* view : {"Dome", "Star field", "Un-tone-mapped", "Raw"})
      EXPECT_EQ(graded(settings(view, display), 0), (Triple{0, 0, 0})) << display << ", " << view;
}

// Its toe makes of less a black that no display's 8 bits tell from 0.
TEST(DomeConfig, TheDomeViewShowsLightOfAThousandth) {
  for (const char* display : kDisplays)
    for (const double code : graded(settings("Dome", display), 1e-3)) EXPECT_GT(code, 0) << display;
  EXPECT_GT(graded(settings("Dome"), std::ldexp(1, -12))[0], 0);
}

TEST(DomeConfig, NoViewTakesAStepBackOverAllHalfGreys) {
  const HalfFrame in = all_greys();
  for (const char* display : kDisplays)
    for (const char* view : {"Dome", "Star field", "Un-tone-mapped", "Raw"}) {
      const GradedFrame out = Grader(settings(view, display)).grade(in);
      for (std::size_t k = 3; k < out.pixels.size(); ++k)
        ASSERT_GE(out.pixels[k], out.pixels[k - 3])
            << display << ", " << view << ", half " << k / 3;
      EXPECT_EQ(out.pixels.back(), 65535) << display << ", " << view;
    }
}

// The two curves of the configuration's comment, one upon the other, with the shoulder of a display
// whose white is `most` times 100 cd/m^2.
double tone(double y, double bend_of_shoulder = 12.5, double most = 1) {
  const double u = std::pow(y / 0.3, 2.4);
  // Where the straight part meets the power: offset/(gamma - 1), with the slope of both there.
  constexpr double kGamma = 2.3, kOffset = 0.25;
  const double bend = kOffset / (kGamma - 1);
  const double slope = std::pow((bend + kOffset) / (1 + kOffset), kGamma) / bend;
  const double g = u < bend * slope ? u / slope : (1 + kOffset) * std::pow(u, 1 / kGamma) - kOffset;
  const double v = 0.35315320814408807 * g;
  const double a = bend_of_shoulder;
  return std::min(most, v < 0.3 ? v : 0.3 + std::log1p(a * (v - 0.3)) / a);
}

double half_of(double x) { return static_cast<float>(Imath::half(static_cast<float>(x))); }

TEST(DomeConfig, TheDomeViewHasTheCurvesThatItsCommentGives) {
  for (double x = std::ldexp(1.0, -10); x < 128; x *= std::sqrt(2.0)) {
    const double y = tone(half_of(x));
    for (const double code : graded(settings("Dome"), x))
      EXPECT_NEAR(std::pow(code, 2.2), y, 3e-3 * y + 1e-6) << x;
  }
}

// SMPTE ST 2084, 5.3, as the standard writes it.
double st2084(double cd_m2) {
  const double m1 = 0.1593017578125, m2 = 78.84375, c1 = 0.8359375, c2 = 18.8515625, c3 = 18.6875;
  const double y = std::pow(cd_m2 / 10000, m1);
  return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}

constexpr double kTenBitCode = 1. / 1023;
constexpr const char* kPqDisplays[] = {"Rec.2100 PQ 1000 nits", "Rec.2100 PQ 500 nits",
                                       "P3-D65 PQ 1000 nits"};

TEST(HdrDisplays, PqCodesAreThoseOfSt2084) {
  for (const char* display : kPqDisplays)
    for (double x = std::ldexp(1.0, -12); x <= 100; x *= std::sqrt(2.0))
      for (const double code : graded(settings("Un-tone-mapped", display), x))
        EXPECT_NEAR(code, st2084(100 * half_of(x)), kTenBitCode) << display << ", " << x;
}

// ITU-R BT.2100, table 5: a grey's light is the scene's to the power 1.2.
TEST(HdrDisplays, HlgCodesAreThoseOfBt2100) {
  for (double x = std::ldexp(1.0, -10); x <= 10; x *= std::sqrt(2.0)) {
    const double e = std::pow(half_of(x) / 10, 1 / 1.2);
    const double wanted =
        e <= 1. / 12 ? std::sqrt(3 * e) : 0.17883277 * std::log(12 * e - 0.28466892) + 0.55991073;
    for (const double code : graded(settings("Un-tone-mapped", "Rec.2100 HLG 1000 nits"), x))
      EXPECT_NEAR(code, wanted, kTenBitCode) << x;
  }
}

// The middle of the scale is that of SDR, and the highlights have all the light of the display.
TEST(HdrDisplays, TheDomeViewReachesTheirWhite) {
  struct Known {
    const char* display;
    double bend, most;
  };
  for (const Known& known : {Known{kPqDisplays[0], 0.5871, 10}, Known{kPqDisplays[1], 1.395, 5},
                             Known{kPqDisplays[2], 0.5871, 10}})
    for (double x = std::ldexp(1.0, -6); x <= 512; x *= std::sqrt(2.0)) {
      const double light = 100 * tone(half_of(x), known.bend, known.most);
      for (const double code : graded(settings("Dome", known.display), x))
        EXPECT_NEAR(code, st2084(light), kTenBitCode) << known.display << ", " << x;
    }
  for (const double code : graded(settings("Dome", "Rec.2100 HLG 1000 nits"), 512))
    EXPECT_NEAR(code, 1, kTenBitCode);
}

// At the largest halves ACES 1.1 comes to within 5 codes of 10 bits of its 1000 cd/m^2.
TEST(HdrDisplays, BlackIsCodeZeroAndAcesReachesItsWhite) {
  for (const char* display : {kPqDisplays[0], kPqDisplays[2]}) {
    EXPECT_EQ(graded(settings("Dome", display), 0), (Triple{0, 0, 0})) << display;
    for (const double code : graded(settings("ACES HDR", display), 60000))
      EXPECT_NEAR(code, st2084(1000), 5 * kTenBitCode) << display;
  }
}

// Linear Rec.709 in the working space.
Triple scene_of(const Triple& rec709, double v) {
  const Imath::M33d& working = working_from_rec709();
  Triple scene{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      scene[static_cast<std::size_t>(i)] += working[i][j] * rec709[static_cast<std::size_t>(j)] * v;
  return scene;
}

constexpr Triple kRedStar{1, 0.55, 0.3}, kBlueStar{0.5, 0.7, 1};

Triple light_of(const GradeSettings& s, const Triple& scene) {
  Triple light = graded(s, scene);
  for (double& channel : light) channel = std::pow(channel, 2.2);
  return light;
}

// Below the shoulder the display's light has the ratios of the scene's.
TEST(DomeConfig, TheDomeViewKeepsTheRatiosOfColoursBelowItsShoulder) {
  for (const Triple& star : {kRedStar, kBlueStar})
    for (const double v : {0.05, 0.1, 0.2}) {
      const Triple light = light_of(settings("Dome"), scene_of(star, v));
      ASSERT_LT(*std::max_element(light.begin(), light.end()), 0.3);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(light[c] / light[1], star[c] / star[1], 5e-3) << v;
    }
}

double saturation(const Triple& light) {
  const auto [least, most] = std::minmax_element(light.begin(), light.end());
  return 1 - *least / *most;
}

// In degrees around the grey axis, red at 0.
double hue(const Triple& l) {
  return std::atan2(std::sqrt(3) * (l[1] - l[2]), 2 * l[0] - l[1] - l[2]) * 180 / std::acos(-1);
}

// A shoulder on each channel turns the hue of what it pales: measured, by 13 degrees of 360 while a
// quarter of its light is still its colour.
TEST(DomeConfig, TheDomeViewPalesBrightColoursToWhite) {
  for (const Triple& star : {kRedStar, kBlueStar}) {
    double before = saturation(star) + 1e-3;
    for (double v = 0.25; v < 3000; v *= 2) {
      const Triple light = light_of(settings("Dome"), scene_of(star, v));
      const double now = saturation(light);
      EXPECT_LE(now, before + 1e-3) << v;
      if (now > 0.25) {
        EXPECT_LT(std::abs(hue(light) - hue(star)), 15) << v << ", saturation " << now;
      }
      before = now;
    }
    EXPECT_LT(before, 0.1);
  }
}

// The display's light has the ratios of the scene's, on displays of any primaries and encoding.
TEST(DomeConfig, TheStarFieldKeepsTheRatiosOfColoursInRec709) {
  for (const double v : {0.05, 1.0, 30.0, 900.0}) {
    const Triple light = light_of(settings("Star field"), scene_of(kRedStar, v));
    for (std::size_t c = 1; c < 3; ++c) EXPECT_NEAR(light[c] / light[0], kRedStar[c], 2e-3) << v;
  }
}

TEST(DomeConfig, TheStarFieldHasTheCurveThatItsCommentGives) {
  for (double x = std::ldexp(1.0, -10); x < 128; x *= std::sqrt(2.0)) {
    const double y = std::min(1.0, std::log1p(4 * half_of(x)) / std::log(257));
    for (const double code : graded(settings("Star field"), x))
      EXPECT_NEAR(std::pow(code, 2.2), y, 3e-3 * y) << x;
  }
}

double srgb(double light) {  // IEC 61966-2-1
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

TEST(DomeConfig, UnToneMappedIsTheStandardsPrimariesAndEncoding) {
  const Triple light{0.7, 0.25, 0.06};
  const Triple scene = scene_of(light, 1);
  const Triple power = graded(settings("Un-tone-mapped", kDisplays[0]), scene),
               piecewise = graded(settings("Un-tone-mapped", kDisplays[2]), scene),
               studio = graded(settings("Un-tone-mapped", kDisplays[3]), scene);
  for (std::size_t c = 0; c < 3; ++c) {
    // Halves have 11 bits, which the matrix spreads.
    EXPECT_NEAR(power[c], std::pow(light[c], 1 / 2.2), 5e-4);
    EXPECT_NEAR(piecewise[c], srgb(light[c]), 5e-4);
    EXPECT_NEAR(studio[c], std::pow(light[c], 1 / 2.4), 5e-4);
  }
}

// DCI-P3 has its primaries against its own white, to which the scene's is adapted, so that a grey
// has equal codes.  P3's red is outside Rec.709 and inside Rec.2020.
TEST(DomeConfig, UnToneMappedHasThePrimariesOfWideDisplays) {
  const auto red = [](const char* display, double gamma) {
    Triple light = graded(settings("Un-tone-mapped", display), scene_of({1, 0, 0}, 1));
    for (double& channel : light) channel = std::pow(channel, gamma);
    return light;
  };
  // Of linear Rec.709 red in P3-D65 (SMPTE RP 431, RP 177) and in Rec.2020 (ITU-R BT.2087).
  const Triple p3 = red("Dome G2.6 P3-D65", 2.6), wide = red("Dome G2.4 Rec.2020", 2.4);
  for (const auto& [light, expected] : {std::pair(p3, Triple{0.8225, 0.0332, 0.0171}),
                                        std::pair(wide, Triple{0.6274, 0.0691, 0.0164})})
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(light[c], expected[c], 1e-3);
  EXPECT_EQ(graded(settings("Dome", "Dome G2.4 Rec.709"), 0.2),
            graded(settings("Dome", "Rec.1886 Rec.709 - Display"), 0.2));
}

TEST(DomeConfig, WhiteIsWhiteOnEveryDisplay) {
  for (const char* display : kDisplays)
    for (const double code : graded(settings("Un-tone-mapped", display), 1))
      EXPECT_NEAR(code, 1, 2e-4) << display;
}

// In floats, which in the upper half of the codes are 1/256 of a code apart.
TEST(DomeConfig, RawIsTheFrameRounded) {
  const HalfFrame in = all_greys();
  const GradedFrame out = Grader(settings("Raw")).grade(in);
  for (std::size_t k = 0; k < in.pixels.size(); ++k)
    ASSERT_NEAR(out.pixels[k], 65535 * std::min<double>(in.pixels[k], 1), 0.5 + 1.0 / 256);
}

// What files say of their codes, by the shipped displays.
TEST(DisplayColours, AreThoseThatTheDisplaysAreSetTo) {
  struct Known {
    const char* display;
    DisplayColour colour;
  };
  for (const Known& known : {
           Known{"Dome G2.2 Rec.709", {DisplayColour::Curve::kPower, 2.2, kRec709Places}},
           Known{"Dome G2.4 Rec.709", {DisplayColour::Curve::kPower, 2.4, kRec709Places}},
           Known{"Dome G2.6 P3-D65", {DisplayColour::Curve::kPower, 2.6, kP3D65Places}},
           Known{"Dome G2.4 Rec.2020", {DisplayColour::Curve::kPower, 2.4, kRec2020Places}},
           Known{"sRGB - Display", {DisplayColour::Curve::kSrgb, 2.2, kRec709Places}},
           Known{"Rec.2100 PQ 1000 nits", {DisplayColour::Curve::kPq, 2.2, kRec2020Places}},
           Known{"Rec.2100 PQ 500 nits", {DisplayColour::Curve::kPq, 2.2, kRec2020Places}},
           Known{"Rec.2100 HLG 1000 nits", {DisplayColour::Curve::kHlg, 2.2, kRec2020Places}},
           Known{"P3-D65 PQ 1000 nits", {DisplayColour::Curve::kPq, 2.2, kP3D65Places}},
       }) {
    const auto colour = Grader(settings("Dome", known.display)).colour();
    ASSERT_TRUE(colour) << known.display;
    EXPECT_EQ(*colour, known.colour) << known.display << ": " << colour->gamma;
  }
}

// The scene's white is adapted to the greenish white of the display, and meant to look white.
TEST(DisplayColours, OfDciP3AreSaidByTheWhiteThatTheEyeIsAdaptedTo) {
  const auto colour = Grader(settings("Dome", "Dome G2.6 DCI-P3")).colour();
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->gamma, 2.6);
  EXPECT_NEAR(colour->xy[6], 0.3127, 2e-4);
  EXPECT_NEAR(colour->xy[7], 0.329, 2e-4);
}

TEST(DisplayColours, OfDataAreNotSaid) { EXPECT_FALSE(Grader(settings("Raw")).colour()); }

}  // namespace
}  // namespace domefall
