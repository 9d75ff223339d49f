#include "pipeline/movie/preset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

using testing::HasSubstr;

constexpr FrameRate kRate{24000, 1001};

std::vector<std::string> options_of(const std::string& preset, const MovieSize& frames,
                                    const ColourTags& tags, const std::string& subtitles = "") {
  return video_options(movie_preset(preset), frames, kRate, tags, subtitles);
}

// What follows the option; empty if it is not there.
std::string value_of(const std::vector<std::string>& options, const std::string& option) {
  const auto found = std::find(options.begin(), options.end(), option);
  return found == options.end() ? "" : *(found + 1);
}

std::string refusal_of(const std::string& preset) {
  try {
    movie_preset(preset);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MoviePreset, TheMatrixOfTheConversionIsThatOfTheTag) {
  for (const char* preset : {"review", "dome", "dome8k", "master"}) {
    const auto rec709 = options_of(preset, {64, 64}, {1, 4, 1});
    EXPECT_THAT(value_of(rec709, "-vf"), HasSubstr(":m=709:"));
    EXPECT_THAT(value_of(rec709, "-vf"), HasSubstr("colorspace=1"));
    EXPECT_EQ(value_of(rec709, "-colorspace"), "1");
    const auto rec2020 = options_of(preset, {64, 64}, {9, 14, 9});
    EXPECT_THAT(value_of(rec2020, "-vf"), HasSubstr(":m=2020_ncl:"));
    EXPECT_EQ(value_of(rec2020, "-colorspace"), "9");
    EXPECT_EQ(value_of(rec2020, "-color_range"), "tv");
    EXPECT_EQ(value_of(rec2020, "-color_primaries"), "9");
    EXPECT_EQ(value_of(rec2020, "-color_trc"), "14");
  }
}

TEST(MoviePreset, HapIsRgbOfFullRange) {
  const auto options = options_of("hap", {64, 64}, {12, 4, 1});
  EXPECT_EQ(value_of(options, "-colorspace"), "0");
  EXPECT_EQ(value_of(options, "-color_range"), "pc");
  EXPECT_EQ(value_of(options, "-format"), "hap_q");
  EXPECT_EQ(value_of(options, "-chunks"), "4");
}

TEST(MoviePreset, TheFramesAreReadAtTheFrameRate) {
  const auto options = input_options({64, 32}, kRate);
  EXPECT_EQ(value_of(options, "-framerate"), "24000/1001");
  EXPECT_EQ(value_of(options, "-video_size"), "64x32");
}

TEST(MoviePreset, WhatIsWrittenOnFramesLeavesTheirTimesAsTheyWere) {
  const auto options = options_of("review", {64, 64}, {1, 4, 1}, "/proc/self/fd/7");
  EXPECT_THAT(value_of(options, "-vf"),
              HasSubstr("setpts=N,ass=filename=/proc/self/fd/7,settb=1001/24000,setpts=N"));
}

TEST(MovieSize, LargerFramesAreScaledDownInTheirShape) {
  EXPECT_EQ(movie_size(movie_preset("review"), {4096, 4096}), (MovieSize{1080, 1080}));
  EXPECT_EQ(movie_size(movie_preset("review"), {3840, 2160}), (MovieSize{1920, 1080}));
  EXPECT_EQ(movie_size(movie_preset("review"), {4000, 1001}), (MovieSize{1920, 480}));
  EXPECT_EQ(movie_size(movie_preset("dome"), {8192, 8192}), (MovieSize{4096, 4096}));
  EXPECT_EQ(movie_size(movie_preset("dome8k"), {8192, 8192}), (MovieSize{8192, 8192}));
  EXPECT_EQ(movie_size(movie_preset("dome"), {100, 100}), (MovieSize{100, 100}));
}

TEST(MovieSize, AWholeSphereIsTwiceAsWideAsHigh) {
  EXPECT_EQ(movie_size(movie_preset("vr360"), {8192, 4096}), (MovieSize{8192, 4096}));
  EXPECT_EQ(movie_size(movie_preset("vr360"), {16384, 8192}), (MovieSize{8192, 4096}));
}

TEST(MovieSize, OddSizesAreForProResAlone) {
  EXPECT_THROW(movie_size(movie_preset("review"), {101, 100}), InputError);
  EXPECT_THROW(movie_size(movie_preset("hap"), {102, 102}), InputError);
  EXPECT_EQ(movie_size(movie_preset("master"), {101, 99}), (MovieSize{101, 99}));
}

TEST(MoviePreset, AnUnknownOneIsRefusedWithWhatThereIs) {
  EXPECT_THAT(refusal_of("reveiw"), HasSubstr("did you mean review?"));
  EXPECT_THAT(refusal_of("h264"), HasSubstr("review, dome, dome8k, master, hap or vr360"));
}

}  // namespace
}  // namespace domefall
