// The shipped configuration, view by view and display by display, against formulas of the
// standards and of its own comments, and against another program's reading of it.

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "pipeline/colour/colour_space.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

const std::string kConfig = source_file("shows/assets/dome.ocio");
constexpr const char* kDisplays[] = {"Dome G2.2 Rec.709", "Dome G2.6 P3-D65", "sRGB - Display",
                                     "Rec.1886 Rec.709 - Display"};
constexpr const char* kViews[] = {"Dome", "ACES SDR", "Star log", "Un-tone-mapped", "Raw"};

GradeSettings settings(const std::string& view, const std::string& display = kDisplays[0]) {
  GradeSettings s;
  s.config = kConfig;
  s.display = display;
  s.view = view;
  return s;
}

using Triple = std::array<double, 3>;

HalfFrame one_pixel(const Triple& rgb) {
  HalfFrame frame(1, 1);
  for (std::size_t c = 0; c < 3; ++c) frame.pixels[c] = static_cast<float>(rgb[c]);
  return frame;
}

Triple graded(const GradeSettings& s, const Triple& rgb) {
  const GradedFrame out = Grader(s).grade(one_pixel(rgb));
  return {out.pixels[0] / 65535.0, out.pixels[1] / 65535.0, out.pixels[2] / 65535.0};
}

Triple graded(const GradeSettings& s, double grey) { return graded(s, Triple{grey, grey, grey}); }

// Every half from 0 to the largest finite, as greys.
HalfFrame all_greys() {
  HalfFrame frame(0x7c00, 1);
  for (int bits = 0; bits < 0x7c00; ++bits)
    for (int c = 0; c < 3; ++c)
      frame.pixels[static_cast<std::size_t>(3 * bits + c)].setBits(
          static_cast<unsigned short>(bits));
  return frame;
}

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
    for (const char* view : {"Dome", "Star log", "Un-tone-mapped", "Raw"})
      EXPECT_EQ(graded(settings(view, display), 0), (Triple{0, 0, 0})) << display << ", " << view;
}

TEST(DomeConfig, TheDomeViewShowsLightOfTwoTenThousandths) {
  for (const char* display : kDisplays)
    for (const double code : graded(settings("Dome", display), 2e-4)) EXPECT_GT(code, 0) << display;
}

TEST(DomeConfig, NoViewTakesAStepBackOverAllHalfGreys) {
  const HalfFrame in = all_greys();
  for (const char* display : kDisplays)
    for (const char* view : {"Dome", "Star log", "Un-tone-mapped", "Raw"}) {
      const GradedFrame out = Grader(settings(view, display)).grade(in);
      for (std::size_t k = 3; k < out.pixels.size(); ++k)
        ASSERT_GE(out.pixels[k], out.pixels[k - 3])
            << display << ", " << view << ", half " << k / 3;
      EXPECT_EQ(out.pixels.back(), 65535) << display << ", " << view;
    }
}

// y = log10(1 + 2 x^1.25) / log10(1201), as the configuration's comment says; below x^1.25 = 0.001
// its straight part departs from it by no more than 0.1 %.
TEST(DomeConfig, TheDomeViewHasTheCurveThatItsCommentGives) {
  for (double x = std::ldexp(1.0, -11); x < 128; x *= std::sqrt(2.0)) {
    const double half = static_cast<float>(Imath::half(static_cast<float>(x)));
    const double y = std::log10(1 + 2 * std::pow(half, 1.25)) / std::log10(1201);
    for (const double code : graded(settings("Dome"), x))
      EXPECT_NEAR(std::pow(code, 2.2), y, 1e-3 * y + 1e-5) << x;
  }
}

// The display's light has the ratios of the scene's, on displays of any primaries and encoding.
TEST(DomeConfig, TheDomeViewKeepsTheRatiosOfColoursInRec709) {
  const Imath::M33d& working = working_from_rec709();
  const Triple star{1, 0.55, 0.3};
  for (const double v : {0.05, 1.0, 30.0, 900.0}) {
    Triple scene{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        scene[static_cast<std::size_t>(i)] += working[i][j] * star[static_cast<std::size_t>(j)] * v;
    const Triple code = graded(settings("Dome"), scene);
    for (std::size_t c = 1; c < 3; ++c)
      EXPECT_NEAR(std::pow(code[c] / code[0], 2.2), star[c], 2e-3) << v;
  }
}

double srgb(double light) {  // IEC 61966-2-1
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

TEST(DomeConfig, UnToneMappedIsTheStandardsPrimariesAndEncoding) {
  const Imath::M33d& working = working_from_rec709();
  const Triple light{0.7, 0.25, 0.06};
  Triple scene{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      scene[static_cast<std::size_t>(i)] += working[i][j] * light[static_cast<std::size_t>(j)];
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

// S-2016-001, where the curve is logarithmic.
double acescct(double linear) { return (std::log2(linear) + 9.72) / 17.52; }
double linear_from(double code) { return std::exp2(17.52 * code - 9.72); }

TEST(Cdl, WorksOnAcescct) {
  GradeSettings s = settings("Raw");
  s.slope = {1.1, 1, 0.9};
  s.offset = {0.01, -0.05, 1 / 17.52};
  s.power = {1, 1.2, 0.95};
  const Triple in{0.05, 0.125, 0.1}, out = graded(s, in);
  for (std::size_t c = 0; c < 3; ++c) {
    const double half = static_cast<float>(Imath::half(static_cast<float>(in[c])));
    const double expected =
        linear_from(std::pow(acescct(half) * s.slope[c] + s.offset[c], s.power[c]));
    EXPECT_NEAR(out[c], expected, 2e-4 * expected + 1e-5);
  }
}

TEST(Cdl, WithoutSaturationIsGreyOfRec709sWeights) {
  GradeSettings s = settings("Raw");
  s.saturation = 0;
  const Triple in{0.5, 0.125, 0.03125};
  const double luma = 0.2126 * acescct(in[0]) + 0.7152 * acescct(in[1]) + 0.0722 * acescct(in[2]);
  for (const double code : graded(s, in)) EXPECT_NEAR(code, linear_from(luma), 1e-4);
}

TEST(Cdl, ThatChangesNothingLeavesTheBytes) {
  GradeSettings identity = settings("Dome");
  identity.slope = identity.power = {1, 1, 1};
  identity.offset = {0, 0, 0};
  identity.saturation = 1;
  EXPECT_EQ(Grader(identity).grade(all_greys()).pixels,
            Grader(settings("Dome")).grade(all_greys()).pixels);
}

// Black at the ends of rows takes a short cut; here it has a colour of its own and light inside it.
TEST(GradeRows, GivesEachPixelWhatItHasAloneWhateverIsAroundIt) {
  GradeSettings lifted = settings("Raw");
  lifted.offset = {0.2, 0.15, 0.1};
  const Grader grader(lifted);
  const GradedFrame black = grader.grade(one_pixel({0, 0, 0}));
  ASSERT_GT(black.pixels[2], 0);
  HalfFrame in(6, 4);
  in.row(1)[3 * 2 + 1] = 0.5f;  // first light in a middle channel
  in.row(1)[3 * 4 + 2] = 0.25f;
  in.row(2)[0] = 1.0f;
  in.row(3)[3 * 5 + 2] = 1.0f;
  const GradedFrame out = grader.grade(in);
  for (std::size_t p = 0; p < 24; ++p) {
    HalfFrame alone(1, 1);
    std::copy_n(&in.pixels[3 * p], 3, alone.pixels.begin());
    const GradedFrame expected = grader.grade(alone);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(out.pixels[3 * p + c], expected.pixels[c]) << "pixel " << p;
  }
}

TEST(GradeRows, MayBeSharedByThreads) {
  const Grader grader(settings("Dome"));
  HalfFrame in(61, 40);
  for (std::size_t k = 0; k < in.pixels.size(); ++k)
    in.pixels[k] = std::exp2(static_cast<float>(k * 37 % 991) / 50 - 12);
  GradedFrame out(in.width, in.height);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back(
        [&, copy = grader, t] { copy.grade_rows(in, 10 * t, 10 * t + 10, out.row(10 * t)); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(out.pixels, grader.grade(in).pixels);
}

TEST(GradeSettings, ThatCannotBeMetSayWhatCould) {
  EXPECT_THAT([] { Grader(settings("Dome", "Wall")); },
              testing::ThrowsMessage<InputError>(testing::AllOf(
                  testing::HasSubstr("no display 'Wall'"), testing::HasSubstr("'Dome G2.6 P3-D65'"),
                  testing::HasSubstr("'sRGB - Display'"))));
  EXPECT_THAT([] { Grader(GradeSettings{}); },
              testing::ThrowsMessage<InputError>("no OpenColorIO configuration is named"));
}

TEST(GradeSettings, NameAConfigurationThatOpenColorIOTakes) {
  const auto file =
      std::filesystem::temp_directory_path() / ("domefall_" + std::to_string(getpid()) + ".ocio");
  GradeSettings s;
  s.config = file;
  for (const char* text : {"ocio_profile_version: 9\n", "not: [a configuration", ""}) {
    std::ofstream(file) << text;
    EXPECT_THAT([&] { Grader grader(s); },
                testing::ThrowsMessage<InputError>(testing::StartsWith(file.string() + ": ")))
        << text;
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace domefall
