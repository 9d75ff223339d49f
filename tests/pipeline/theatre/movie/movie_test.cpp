// What a movie is asked for: presets, colour tags, and what is written on its frames.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "pipeline/grade/grader.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/theatre/movie/burn_in.h"
#include "pipeline/theatre/movie/colour_tags.h"
#include "pipeline/theatre/movie/preset.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  return message_of([&] { movie_preset(preset); });
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

Sound sound_of(int channels) {
  Sound sound;
  sound.files.resize(1);
  sound.channels = sound.files[0].channels = channels;
  return sound;
}

TEST(MoviePreset, HasAsMuchSoundAsItsCodec) {
  for (const char* preset : {"review", "dome", "dome8k", "vr360"}) {
    EXPECT_NO_THROW(require_fitting(movie_preset(preset), kRate, sound_of(8))) << preset;
    EXPECT_THROW(require_fitting(movie_preset(preset), kRate, sound_of(12)), InputError) << preset;
  }
  for (const char* preset : {"master", "hap"})
    EXPECT_NO_THROW(require_fitting(movie_preset(preset), kRate, sound_of(16))) << preset;
}

TEST(MoviePreset, HasNoRateThatFfmpegWouldRound) {
  const MoviePreset& dome = movie_preset("dome");
  EXPECT_NO_THROW(require_fitting(dome, {240000, 1001}, {}));
  EXPECT_THROW(require_fitting(dome, {14985617, 500000}, {}), InputError);
}

TEST(MoviePreset, NamesItsFilesOfSoundAsFiles) {
  Sound sound = sound_of(1);
  sound.files[0].file = "-y:%03d.mp3";
  const auto options = sound_inputs(sound);
  EXPECT_EQ(value_of(options, "-i"), "file:" + std::filesystem::absolute("-y:%03d.mp3").string());
  EXPECT_EQ(value_of(options, "-protocol_whitelist"), "file");
  EXPECT_EQ(value_of(options, "-ignore_length"), "");
  sound.files[0].wave.emplace().unfilled = true;
  EXPECT_EQ(value_of(sound_inputs(sound), "-ignore_length"), "1");
}

TEST(MoviePreset, JoinsFilesOfOneChannelByTheirNamesOrNumbers) {
  Sound sound;
  sound.files.resize(2);
  sound.layout = "FL+FR";
  EXPECT_THAT(value_of(sound_options(sound, 0, 24, {24, 1}), "-filter_complex"),
              HasSubstr("[c0][c1]join=inputs=2:channel_layout=FL+FR:map=0.0-FL|1.0-FR,"
                        "atrim=start=0.000000000:end=1.000000000"));
  sound.layout.clear();
  EXPECT_THAT(value_of(sound_options(sound, 0, 24, {24, 1}), "-filter_complex"),
              HasSubstr("[c0][c1]amerge=inputs=2,"));
}

TEST(MovieSize, LargerFramesAreScaledDownInTheirShape) {
  EXPECT_EQ(movie_size(movie_preset("review"), {4096, 4096}), (MovieSize{1080, 1080}));
  EXPECT_EQ(movie_size(movie_preset("review"), {3840, 2160}), (MovieSize{1920, 1080}));
  EXPECT_EQ(movie_size(movie_preset("review"), {4000, 1001}), (MovieSize{1920, 480}));
  EXPECT_EQ(movie_size(movie_preset("dome"), {8192, 8192}), (MovieSize{4096, 4096}));
  EXPECT_EQ(movie_size(movie_preset("dome8k"), {8192, 8192}), (MovieSize{8192, 8192}));
  EXPECT_EQ(movie_size(movie_preset("dome"), {100, 100}), (MovieSize{100, 100}));
}

TEST(MoviePreset, SaysHowWidePixelsAreThatAreNotSquare) {
  for (const char* preset : {"review", "dome", "master", "hap"}) {
    EXPECT_THAT(value_of(options_of(preset, {64, 64}, {1, 4, 1}, "subtitles"), "-vf"),
                Not(HasSubstr("setsar")));
    const std::string filters =
        value_of(options_of(preset, {64, 64, 16. / 11}, {1, 4, 1}, "subtitles"), "-vf");
    EXPECT_THAT(filters, HasSubstr(",setsar=16/11"));
    EXPECT_THAT(filters, HasSubstr("ass=filename=subtitles:original_size=64x44,"));
  }
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

// The tags of codes of the shipped configuration.
ColourTags tags_for(const std::string& display, const std::string& view = "") {
  GradeSettings settings{.config = source_file("shows/assets/dome.ocio"),
                         .shipped = true,
                         .display = display,
                         .view = view};
  return tags_of(Grader(settings).colour());
}

TEST(ColourTags, OfTheShippedDisplaysAreWhatTheirNamesSay) {
  EXPECT_EQ(tags_for("Dome G2.2 Rec.709"), (ColourTags{1, 4, 1}));
  EXPECT_EQ(tags_for("Dome G2.4 Rec.709"), (ColourTags{1, 1, 1}));
  EXPECT_EQ(tags_for("Rec.1886 Rec.709 - Display"), (ColourTags{1, 1, 1}));
  EXPECT_EQ(tags_for("sRGB - Display"), (ColourTags{1, 13, 1}));
  EXPECT_EQ(tags_for("Dome G2.4 Rec.2020"), (ColourTags{9, 14, 9}));
}

TEST(ColourTags, APowerOf26HasNoTagButItsPrimariesHave) {
  EXPECT_EQ(tags_for("Dome G2.6 P3-D65"), (ColourTags{12, 2, 1}));
  EXPECT_EQ(tags_for("Dome G2.6 DCI-P3"), (ColourTags{11, 2, 1}));
}

TEST(ColourTags, OfHdrAreThoseOfBt2100) {
  EXPECT_EQ(tags_for("Rec.2100 PQ 1000 nits"), (ColourTags{9, 16, 9}));
  EXPECT_EQ(tags_for("Rec.2100 HLG 1000 nits"), (ColourTags{9, 18, 9}));
  EXPECT_EQ(tags_for("P3-D65 PQ 1000 nits"), (ColourTags{12, 16, 1}));
}

// ST 2084 gives 100 cd/m^2 the code 0.508078 and 1000 the code 0.751827.
TEST(LightLevels, AreThoseOfTheBrightestChannelOfPixelsAndFrames) {
  const auto code = [](double of_one) { return static_cast<unsigned short>(of_one * 65535 + 0.5); };
  GradedFrame even(2, 1), point(2, 1);
  for (std::size_t k = 1; k < 6; k += 3) even.pixels[k] = code(0.508078);
  point.pixels[2] = code(0.751827);
  point.pixels[0] = code(0.508078);
  LightLevels levels;
  const auto take = [&levels](const GradedFrame& frame) {
    FrameLevels of_frame(frame.width, frame.height);
    of_frame.take(0, frame.height, frame.pixels.data());
    of_frame.add_to(levels);
  };
  take(even);
  EXPECT_NEAR(levels.content, 100, 0.1);
  EXPECT_NEAR(levels.frame_average, 100, 0.1);
  take(point);
  EXPECT_NEAR(levels.content, 1000, 1);
  EXPECT_NEAR(levels.frame_average, 500, 0.5);
  take(even);
  EXPECT_NEAR(levels.content, 1000, 1);
}

// The stream of a movie that was begun without its levels gets them in as many bytes, of which no two
// in succession are 0.
TEST(LightLevels, HaveAPlaceInTheStream) {
  using namespace std::string_literals;
  EXPECT_EQ(in_hevc({1000, 99.5})[0], "\x4e\x01\x90\x04\x03\xe8\x00\x64\x80"s);
  EXPECT_EQ(in_hevc({255.5, 0})[0], "\x4e\x01\x90\x04\x01\x01\x00\x01\x80"s);
  EXPECT_EQ(in_hevc(kLevelsToCome)[0], "\x4e\x01\x90\x04\xff\xfe\xff\xfd\x80"s);
  EXPECT_EQ(in_hevc({1000, 99.5})[1], "cll=01000,00100");
}

TEST(LightLevels, AreForPqByX265Alone) {
  EXPECT_TRUE(takes_light_levels(movie_preset("dome"), {9, 16, 9}));
  EXPECT_FALSE(takes_light_levels(movie_preset("dome"), {9, 18, 9}));
  EXPECT_FALSE(takes_light_levels(movie_preset("review"), {9, 16, 9}));
}

TEST(ColourTags, EveryViewOfADisplayHasTheSame) {
  for (const char* view : {"Dome", "ACES SDR", "Star field", "Un-tone-mapped"})
    EXPECT_EQ(tags_for("sRGB - Display", view), (ColourTags{1, 13, 1})) << view;
}

TEST(ColourTags, CodesOfNoDisplayHaveNone) {
  EXPECT_EQ(tags_for("sRGB - Display", "Raw"), (ColourTags{2, 2, 1}));
}

TEST(ColourTags, SayWhatTheyAre) {
  EXPECT_EQ(describe({12, 4, 1}),
            "primaries smpte432 (P3-D65), transfer bt470m (gamma 2.2), matrix bt709");
  EXPECT_EQ(describe({2, 2, 1}), "primaries unspecified, transfer unspecified, matrix bt709");
}

TEST(BurnIn, OfTheLastStableOrbitSaysHalfTheSpeedOfLight) {
  const Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  const std::string text = burn_in(show, {100, 101}, {1080, 1080});
  EXPECT_THAT(text, HasSubstr("Dialogue: 0,0:00:00.00,0:00:00.10,a,frame 100\\N0:03.333\n"));
  EXPECT_THAT(text, HasSubstr("Dialogue: 1,0:00:00.10,0:00:00.20,b,region I\\Nr = 6.0000 M\n"));
  // v = sqrt(M/(r - 2M)); light from behind and ahead: sqrt(2/3)/gamma (1 -+ v).
  EXPECT_THAT(text, HasSubstr(",d,v = 0.50000 c\\N1+z = 0.4714 to 1.4142\n"));
  EXPECT_THAT(text, HasSubstr("PlayResX: 1080\n"));
}

TEST(BurnIn, InsideTheHorizonNobodyStandsStill) {
  Show show = read_show(source_file("shows/first_light.yaml"));
  const std::string text = burn_in(show, {300}, {540, 540});  // r = 1.2 M
  EXPECT_THAT(text, HasSubstr("region II\\N"));
  EXPECT_THAT(text, HasSubstr("(free fall)"));
  EXPECT_THAT(text, Not(HasSubstr("v = 1")));
}

TEST(BurnIn, TimesGoOnAfterAnHour) {
  const Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  const std::string text = burn_in(show, std::vector<int>(36002, 0), {540, 540});
  EXPECT_THAT(text, HasSubstr("Dialogue: 0,1:00:00.10,1:00:00.20,a,frame 0\\N0:00\n"));
}

TEST(BurnIn, IsNoneOverFramesThatHaveItAsAnOverlay) {
  Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  show.overlays = {OverlayKind::kRim, OverlayKind::kBurnIn};
  EXPECT_EQ(burn_in(show, {100}, {540, 540}), "");
  show.overlays = {OverlayKind::kRim};
  EXPECT_THAT(burn_in(show, {100}, {540, 540}), HasSubstr(",a,frame 100"));
}

}  // namespace
}  // namespace domefall
