// What the settings of a grade do: a show's CDL, rows that threads share, and what cannot be met.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "tests/pipeline/grade/shipped_grade.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

// S-2016-001, where the curve is logarithmic.
double acescct(double linear) { return (std::log2(linear) + 9.72) / 17.52; }
double linear_from(double code) { return std::exp2(17.52 * code - 9.72); }

TEST(Cdl, WorksOnAcescct) {
  GradeSettings s = settings("Raw");
  s.cdl.slope = {1.1, 1, 0.9};
  s.cdl.offset = {0.01, -0.05, 1 / 17.52};
  s.cdl.power = {1, 1.2, 0.95};
  const Triple in{0.05, 0.125, 0.1}, out = graded(s, in);
  for (std::size_t c = 0; c < 3; ++c) {
    const double half = static_cast<float>(Imath::half(static_cast<float>(in[c])));
    const double expected =
        linear_from(std::pow(acescct(half) * s.cdl.slope[c] + s.cdl.offset[c], s.cdl.power[c]));
    EXPECT_NEAR(out[c], expected, 2e-4 * expected + 1e-5);
  }
}

TEST(Cdl, WithoutSaturationIsGreyOfRec709sWeights) {
  GradeSettings s = settings("Raw");
  s.cdl.saturation = 0;
  const Triple in{0.5, 0.125, 0.03125};
  const double luma = 0.2126 * acescct(in[0]) + 0.7152 * acescct(in[1]) + 0.0722 * acescct(in[2]);
  for (const double code : graded(s, in)) EXPECT_NEAR(code, linear_from(luma), 1e-4);
}

TEST(Cdl, ThatChangesNothingLeavesTheBytes) {
  GradeSettings identity = settings("Dome");
  identity.cdl.slope = identity.cdl.power = {1, 1, 1};
  identity.cdl.offset = {0, 0, 0};
  identity.cdl.saturation = 1;
  EXPECT_EQ(Grader(identity).grade(all_greys()).pixels,
            Grader(settings("Dome")).grade(all_greys()).pixels);
}

// Black at the ends of rows takes a short cut; here it has a colour of its own and light inside it.
TEST(GradeRows, GivesEachPixelWhatItHasAloneWhateverIsAroundIt) {
  GradeSettings lifted = settings("Raw");
  lifted.cdl.offset = {0.2, 0.15, 0.1};
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
  EXPECT_THAT(message_of([] { Grader(settings("Dome", "Wall")); }),
              testing::AllOf(testing::HasSubstr("no display 'Wall'"),
                             testing::HasSubstr("'Dome G2.6 P3-D65'"),
                             testing::HasSubstr("'sRGB - Display'")));
  EXPECT_THAT(
      message_of([] { Grader(settings("Doom")); }),
      testing::HasSubstr(
          "has no view 'Doom' for the display 'Dome G2.2 Rec.709'; it has 'Dome', 'ACES SDR', "
          "'Star field'"));
  EXPECT_EQ(message_of([] { Grader(GradeSettings{}); }), "no OpenColorIO configuration is named");
}

using GradeConfigs = TestFolder;

TEST_F(GradeConfigs, AreWhatOpenColorIOTakes) {
  GradeSettings s;
  s.config = folder_ / "config.ocio";
  for (const char* text : {"ocio_profile_version: 9\n", "not: [a configuration", ""}) {
    put(s.config, text);
    EXPECT_TRUE(message_of([&] { Grader grader(s); }).starts_with(s.config.string() + ": "))
        << text;
  }
}

// Of a version that no library has yet, and of a transform that only newer ones have.
TEST_F(GradeConfigs, OfNewerLibrariesSayWhichVersionAndWhere) {
  GradeSettings s;
  s.config = folder_ / "config.ocio";
  std::string text = contents(kConfig);
  put(s.config, "\n" + std::string(text).replace(text.find("2.1"), 3, "2.99"));
  EXPECT_THAT(message_of([&] { Grader grader(s); }),
              testing::HasSubstr("config.ocio: line 2: a configuration of version 2.99 needs "
                                 "OpenColorIO 2.99 or newer, and this is "));
  const std::string known = "SDR-VIDEO_1.0";
  put(s.config, text.replace(text.find(known), known.size(), "SDR-12345nit_2.0"));
  EXPECT_THAT(message_of([&] { Grader grader(s); }),
              testing::AllOf(testing::ContainsRegex("config.ocio: line [0-9]+: OpenColorIO "),
                             testing::HasSubstr("those of ACES 2 need 2.4 or newer")));
}

}  // namespace
}  // namespace domefall
