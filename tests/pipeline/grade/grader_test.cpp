#include "pipeline/grade/grader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "pipeline/base/simd/dispatch.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

GradeSettings shipped(const std::string& view = "") {
  return {.config = source_file("shows/assets/dome.ocio"), .view = view};
}

// One row: black, then growing greys, a stop apart.
HalfFrame greys() {
  HalfFrame frame(32, 1);
  for (int i = 1; i < 32; ++i)
    for (int c = 0; c < 3; ++c) frame.row(0)[3 * i + c] = std::ldexp(1.0f, i - 16);
  return frame;
}

TEST(Grader, WithAnotherCdlIsThatOfAShowWithThatCdl) {
  GradeSettings settings = shipped();
  settings.cdl.slope = {1.1, 1, 0.9};
  const Grader of_show(settings);
  GradeSettings changed = settings;
  changed.cdl.offset = {0.05, 0, -0.05};
  changed.cdl.saturation = 0.5;
  const Grader other = of_show.with(changed.cdl);
  EXPECT_EQ(other.grade(greys()).pixels, Grader(changed).grade(greys()).pixels);
  EXPECT_NE(other.grade(greys()).pixels, of_show.grade(greys()).pixels);
  EXPECT_EQ(other.with(settings.cdl).grade(greys()).pixels, of_show.grade(greys()).pixels);
  EXPECT_EQ(other.transform_id(), of_show.transform_id()) << "frames name their CDLs themselves";
  EXPECT_EQ(other.view(), of_show.view());
}

// Rows of colours from a red star's to a hot one's, of all brightness, and some that no star has.
constexpr int kColouredRows = 48;
void put_colours(HalfFrame& frame) {
  for (int y = 0; y < kColouredRows; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const float v = std::exp2(static_cast<float>(x) / 80 - 14);
      const float hue = static_cast<float>(y) / (kColouredRows - 1);  // from red to blue
      Imath::half* rgb = frame.row(y) + 3 * x;
      rgb[0] = v * (1 - 0.7f * hue);
      rgb[1] = v * (0.6f + 0.2f * std::sin(6 * hue));
      rgb[2] = v * (0.05f + 0.95f * hue);
    }
  for (int x = 0; x < frame.width; x += 7) frame.row(11)[3 * x + 1] = frame.row(11)[3 * x];
  frame.row(13)[0] = -1.0f, frame.row(13)[4] = HUGE_VALF;
}

struct Colours {
  HalfFrame large{2048, 1024}, small{2048, kColouredRows};
  Colours() { put_colours(large), put_colours(small); }
};

// The largest difference between the grade of a small frame, which is by the formulas, and that of a
// large one that begins with the same rows.
int worst_error(const Grader& grader, const HalfFrame& large, const HalfFrame& small) {
  const GradedFrame exact = grader.grade(small), quick = grader.grade(large);
  int worst = 0;
  for (std::size_t k = 0; k < exact.pixels.size(); ++k)
    worst = std::max(worst, std::abs(exact.pixels[k] - quick.pixels[k]));
  return worst;
}

// The bound is half a step of 12 bits, 8 of 65535.  A small frame is graded by the formulas.
TEST(LargeFrames, AreGradedByATableToHalfATwelveBitCode) {
  const auto [large, small] = Colours();
  for (const char* view : {"Dome", "ACES SDR"}) {
    const Grader grader(shipped(view));
    ASSERT_FALSE(grader.table_error(small));
    const auto table = grader.table_error(large);
    ASSERT_TRUE(table);
    EXPECT_LT(table->error, 0.5 / 4095) << view;
    EXPECT_GT(table->held, 0.4) << view;
    EXPECT_LE(worst_error(grader, large, small), 8) << view;
  }
}

TEST(LargeFrames, AreStoodForBySmallOnes) {
  const auto [large, small] = Colours();
  const Grader grader(shipped()), as_large = grader.as_for(large.width, large.height);
  ASSERT_TRUE(as_large.table_error(small));
  const GradedFrame whole = grader.grade(large), part = as_large.grade(small);
  EXPECT_TRUE(std::equal(part.pixels.begin(), part.pixels.end(), whole.pixels.begin()));
  EXPECT_FALSE(grader.as_for(small.width, small.height).table_error(large));
}

// Their red is at the border of the display's gamut, where the code leaves black infinitely
// steeply.  Between the places where the table was compared, it is off by 23 of 65535.
TEST(LargeFrames, OfDarkBluesKeepTheBoundWhereRedLeavesBlack) {
  HalfFrame large(2048, 1024), small(2048, 48);
  for (HalfFrame* frame : {&large, &small})
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 2048; ++x) {
        const float blue = std::exp2(static_cast<float>(y) / 8 - 11);
        Imath::half* rgb = frame->row(y) + 3 * x;
        rgb[0] = blue * (0.26f + 0.2f * static_cast<float>(x) / 2048);
        rgb[1] = blue * (0.8f + 0.15f * static_cast<float>(x % 7) / 7);
        rgb[2] = blue;
      }
  const Grader grader(shipped());
  ASSERT_TRUE(grader.table_error(large));
  EXPECT_LE(worst_error(grader, large, small), 8);
}

// A moving CDL: a gentle one, one whose slope, power and saturation all differ from 1, and one that
// takes all colour.  What it makes negative or too colourful goes by the formulas.
TEST(LargeFrames, WithAnyCdlAreGradedToHalfATwelveBitCode) {
  const auto [large, small] = Colours();
  std::array<Cdl, 3> cdls;
  cdls[0].offset = {0.05, 0.05, 0.05};
  cdls[1].slope = {1.1, 1, 0.93}, cdls[1].offset = {0.02, -0.01, 0};
  cdls[1].power = {1.1, 1, 0.9}, cdls[1].saturation = 0.7;
  cdls[2].saturation = 0;
  const Grader of_show(shipped());
  for (const Cdl& cdl : cdls) {
    const Grader grader = of_show.with(cdl);
    const auto table = grader.table_error(large);
    ASSERT_TRUE(table);
    EXPECT_LT(table->error, 0.5 / 4095);
    const int worst = worst_error(grader, large, small);
    EXPECT_LE(worst, 8);
    EXPECT_GT(worst, 0) << "the formulas were followed";
    const std::size_t black = 3 * 2048 * (kColouredRows + 1);
    const GradedFrame quick = grader.grade(large), blacks = grader.grade(HalfFrame(1, 1));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(quick.pixels[black + c], blacks.pixels[c]);
  }
}

// So steep is this CDL about a light of 1 that a float's last digit there becomes several codes.
TEST(LargeFrames, AreGradedByTheFormulasWhereACdlMakesTheTableErr) {
  const auto [large, small] = Colours();
  Cdl cdl;
  const double offset = 0.5 - 3000 * 9.72 / 17.52;
  cdl.slope = {3000, 3000, 3000}, cdl.offset = {offset, offset, offset};
  const Grader grader = Grader(shipped()).with(cdl);
  EXPECT_FALSE(grader.table_error(large));
  const GradedFrame exact = grader.grade(small), whole = grader.grade(large);
  EXPECT_TRUE(std::equal(exact.pixels.begin(), exact.pixels.end(), whole.pixels.begin()));
}

TEST(LargeFrames, HaveTheSameBytesForAnySplitIntoRowsAndAnyInstructionSet) {
  HalfFrame large(2048, 1024);
  put_colours(large);
  Cdl cdl;
  cdl.offset = {0.02, 0, -0.01}, cdl.power = {1.1, 1, 0.9};
  const Grader grader = Grader(shipped()).with(cdl);
  const GradedFrame whole = grader.grade(large);
  const Simd before = simd_in_use();
  for (const Simd level : kEverySimd) {
    if (!processor_has(level)) continue;
    use_simd(level);
    GradedFrame parts(large.width, large.height);
    for (int y = 0; y < large.height; y += 10)
      grader.grade_rows(large, y, std::min(y + 10, large.height), parts.row(y));
    EXPECT_EQ(whole.pixels, parts.pixels) << name_of(level);
  }
  use_simd(before);
}

TEST(Grader, IsTheSameWhateverTheUserSetForOtherPrograms) {
  const GradedFrame plain = Grader(shipped()).grade(greys());
  setenv("OCIO_ACTIVE_DISPLAYS", "sRGB - Display", 1);
  setenv("OCIO_ACTIVE_VIEWS", "Raw", 1);
  setenv("OCIO_OPTIMIZATION_FLAGS", "0", 1);
  const Grader grader(shipped());
  EXPECT_EQ(grader.display(), "Dome G2.2 Rec.709");
  EXPECT_EQ(grader.view(), "Dome");
  EXPECT_EQ(grader.grade(greys()).pixels, plain.pixels);
}

}  // namespace
}  // namespace domefall
