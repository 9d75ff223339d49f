#include "pipeline/image/frame_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <random>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/image/read_graded.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using FrameFile = TestFolder;
using GradedFiles = TestFolder;

HalfFrame sample_frame() {
  HalfFrame frame(40, 37);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0, 3);
  for (auto& v : frame.pixels) v = value(random);
  frame.pixels[5] = 65504.0f;
  return frame;
}

FrameInfo sample_info() {
  return {.title = "Grüße, a \"title\"",
          .show = "00112233445566778899aabbccddeeff",
          .key = "0123456789abcdef0123456789abcdef",
          .frame = 42,
          .region = "II",
          .r = 1.0 / 3,
          .proper_time = 77.25,
          .frames_per_second = 30,
          .projection = "domemaster",
          .software = "Domefall"};
}

WantedFrame wanted_sample() {
  return {sample_info().key, sample_info().title, sample_info().projection, 40, 37};
}

TEST_F(FrameFile, ComesBackBitForBitWithItsInfo) {
  const HalfFrame frame = sample_frame();
  const auto path = folder_ / "f.exr";
  write_frame(path, frame, sample_info());
  const auto [read, info] = read_frame(path);
  EXPECT_EQ(std::memcmp(read.pixels.data(), frame.pixels.data(), frame.pixels.size() * 2), 0);
  EXPECT_EQ(info.title, sample_info().title);
  EXPECT_EQ(info.show, sample_info().show);
  EXPECT_EQ(info.key, sample_info().key);
  EXPECT_EQ(info.frame, 42);
  EXPECT_EQ(info.r, 1.0 / 3);
  EXPECT_EQ(info.proper_time, 77.25);
  EXPECT_EQ(info.region, "II");
  EXPECT_EQ(check_frame(path, wanted_sample()).condition, FrameCondition::kGood);
}

// What a half cannot hold becomes the largest half when it is read for grading.
TEST_F(FrameFile, OfFloatsIsReadAsHalves) {
  FloatImage frame(3, 2);
  for (std::size_t k = 0; k < frame.pixels.size(); ++k)
    frame.pixels[k] = 0.1f * static_cast<float>(k);
  frame.pixels[4] = 1e9f;
  FrameInfo given = sample_info();
  given.owner = "A planetarium";
  given.pixel_aspect = 16. / 11;
  write_frame(folder_ / "f.exr", frame, given, ExrCompression::kPiz);
  const auto [read, info] = read_frame(folder_ / "f.exr");
  for (std::size_t k = 0; k < frame.pixels.size(); ++k)
    EXPECT_EQ(static_cast<float>(read.pixels[k]),
              k == 4 ? 65504.0f : static_cast<float>(Imath::half(frame.pixels[k])));
  EXPECT_EQ(info.owner, "A planetarium");
  EXPECT_NEAR(info.pixel_aspect, 16. / 11, 1e-7);
  EXPECT_EQ(info.key, given.key);
}

// As other programs ask for it: exact, and counted as editors count.
TEST_F(FrameFile, SaysItsRateAndItsTime) {
  FrameInfo info = sample_info();
  info.frame = 30 * (3600 * 25 + 60 * 2 + 3) + 4;
  write_frame(folder_ / "a.exr", sample_frame(), info);
  const auto spec_of = [this](const char* name) {
    return OIIO::ImageInput::open((folder_ / name).string())->spec();
  };
  OIIO::ImageSpec spec = spec_of("a.exr");
  int rate[2] = {};
  ASSERT_TRUE(spec.getattribute("framesPerSecond", OIIO::TypeRational, rate));
  EXPECT_EQ(rate[0], 30);
  EXPECT_EQ(rate[1], 1);
  EXPECT_EQ(spec.find_attribute("smpte:TimeCode")->get_string(), "01:02:03:04");
  for (const int pairs : {50, 60}) {
    info.frames_per_second = pairs;
    info.frame = pairs * (60 * 2 + 3) + 9;
    write_frame(folder_ / "pairs.exr", sample_frame(), info);
    std::uint32_t code[2] = {};
    ASSERT_TRUE(spec_of("pairs.exr").getattribute("smpte:TimeCode", OIIO::TypeTimeCode, code));
    const std::uint32_t second_of_pair = 1u << 15, two_minutes_three = 0x00020300;
    EXPECT_EQ(code[0], two_minutes_three | second_of_pair | 4) << pairs;
  }
  info.frames_per_second = 59.94;
  write_frame(folder_ / "b.exr", sample_frame(), info);
  spec = spec_of("b.exr");
  ASSERT_TRUE(spec.getattribute("framesPerSecond", OIIO::TypeRational, rate));
  EXPECT_EQ(rate[0], 60000);
  EXPECT_EQ(rate[1], 1001);
  EXPECT_FALSE(spec.find_attribute("smpte:TimeCode"));
}

TEST_F(FrameFile, OfAnotherProgramIsRefusedByName) {
  put(folder_ / "f.exr", "not an image");
  EXPECT_TRUE(message_of([&] {
                read_frame(folder_ / "f.exr");
              }).starts_with((folder_ / "f.exr").string() + ": "));
}

constexpr GradedKind kEveryKind[] = {GradedKind::kPng16, GradedKind::kPng8, GradedKind::kTiff16,
                                     GradedKind::kTiff8, GradedKind::kJpeg};

GradedFrame graded_sample() {
  GradedFrame frame(33, 21);
  std::mt19937 random(5);
  for (auto& v : frame.pixels) v = static_cast<unsigned short>(random());
  return frame;
}

GradedInfo graded_info() {
  return {.key = "fedcba98765432100123456789abcdef",
          .title = "two\nlines",
          .frame = 7,
          .display = "Dome",
          .view = "Dome",
          .software = "Domefall",
          .projection = "domemaster"};
}

WantedFrame wanted_graded(int width, int height) {
  return {graded_info().key, graded_info().title, graded_info().projection, width, height};
}

TEST_F(GradedFiles, KeepsEveryBitAsPngAndAsTiff) {
  const GradedFrame frame = graded_sample();
  for (const char* name : {"g.png", "g.tif"}) {
    const auto path = folder_ / name;
    write_graded(path, frame, graded_info(), format_by_name(path));
    const std::string once = contents(path);
    write_graded(path, frame, graded_info(), format_by_name(path));
    EXPECT_EQ(contents(path), once) << "the same frame has the same bytes";
    EXPECT_EQ(check_frame(path, wanted_graded(33, 21)).condition, FrameCondition::kGood);
    const auto in = OIIO::ImageInput::open(path.string());
    GradedFrame read(33, 21);
    ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, read.pixels.data()));
    EXPECT_EQ(read.pixels, frame.pixels);
    // The time of writing would make the bytes different a second later.
    const std::string time(in->spec().get_string_attribute("DateTime"));
    EXPECT_TRUE(time.empty() || time.starts_with("1970")) << name;
  }
}

// As a frame is graded: each row once, whoever asks for it.
TEST_F(GradedFiles, HaveTheSameBytesForAnyNumberOfThreads) {
  GradedFrame frame(300, 900);
  std::mt19937 random(5);
  for (auto& v : frame.pixels) v = static_cast<unsigned short>(random() % 1000);
  for (const GradedKind kind : kEveryKind) {
    const auto whole = folder_ / "whole", rows = folder_ / "rows";
    write_graded(whole, frame, graded_info(), {kind});
    for (const int threads : {1, 2, 4}) {
      set_file_threads(threads);
      std::vector<std::atomic<int>> asked(static_cast<std::size_t>(frame.height));
      const auto source = [&](int first, int end, unsigned short* rgb) {
        for (int y = first; y < end; ++y) ++asked[static_cast<std::size_t>(y)];
        std::copy(frame.row(first), frame.row(end), rgb);
        EXPECT_FALSE(std::filesystem::exists(rows));
      };
      write_graded(rows, {frame.width, frame.height, source}, graded_info(), {kind});
      EXPECT_TRUE(contents(rows) == contents(whole)) << static_cast<int>(kind);
      for (const auto& count : asked) EXPECT_EQ(count, 1);
      std::filesystem::remove(rows);
    }
    set_file_threads(0);
  }
}

// As programs read it by which pictures are shown.
TEST_F(GradedFiles, SayHowWideTheirPixelsAre) {
  GradedInfo info = graded_info();
  info.pixel_aspect = 16. / 11;
  for (const GradedKind kind : kEveryKind) {
    const auto path = folder_ / (std::string("g.") + extension_of(kind));
    write_graded(path, graded_sample(), info, {kind});
    EXPECT_EQ(check_frame(path, wanted_graded(33, 21)).condition, FrameCondition::kGood);
    const auto spec = OIIO::ImageInput::open(path.string())->spec();
    const double across = spec.get_float_attribute("XResolution"),
                 down = spec.get_float_attribute("YResolution");
    EXPECT_NEAR(down / across, 16. / 11, 1e-6) << path;
  }
}

TEST_F(GradedFiles, AreReadBackOnceTheirDigestIsRight) {
  const GradedFrame frame = graded_sample();
  const GradedInfo info = graded_info();
  const WantedFrame wanted{info.key, info.title, info.projection, frame.width, frame.height};
  for (const GradedKind kind : kEveryKind) {
    const auto path = folder_ / (std::string("g.") + extension_of(kind));
    write_graded(path, frame, graded_info(), {kind});
    GradedFrame read;
    ASSERT_EQ(read_graded(path, wanted, read), FrameCondition::kGood);
    EXPECT_EQ(std::pair(read.width, read.height), std::pair(frame.width, frame.height));
    if (format_id({kind}).empty()) {
      EXPECT_EQ(read.pixels, frame.pixels);
    } else {
      for (const unsigned short code : read.pixels) ASSERT_EQ(code % 257, 0) << "of 8 bits";
    }
    std::string damaged = contents(path);
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
    put(path, damaged);
    EXPECT_EQ(read_graded(path, wanted, read), FrameCondition::kDamaged);
  }
  GradedFrame read;
  WantedFrame other = wanted;
  other.key = "another";
  write_graded(folder_ / "g.png", frame, info, {GradedKind::kPng16});
  EXPECT_NE(read_graded(folder_ / "g.png", other, read), FrameCondition::kGood);
  EXPECT_EQ(read_graded(folder_ / "none.png", wanted, read), FrameCondition::kMissing);
}

TEST_F(GradedFiles, AreNotThereIfARowFails) {
  const auto rows = [](int first, int, unsigned short*) {
    if (first > 0) throw std::runtime_error("row");
  };
  for (const int threads : {0, 2}) {
    set_file_threads(threads);
    for (const GradedKind kind : kEveryKind)
      EXPECT_THROW(write_graded(folder_ / "g", {300, 900, rows}, graded_info(), {kind}),
                   std::runtime_error);
  }
  set_file_threads(0);
  EXPECT_EQ(file_count(), 0);
}

// A PNG's readers check the sum of the chunk that holds it.
TEST_F(GradedFiles, HaveTheDigestOfTheFileAtTheEndOfTheirDescription) {
  GradedInfo info = graded_info();
  info.title = std::string(10'000, 'x');
  for (const char* name : {"g.png", "g.tif", "g.jpg"}) {
    write_graded(folder_ / name, graded_sample(), info, format_by_name(name));
    WantedFrame wanted = wanted_graded(33, 21);
    wanted.title = info.title;
    EXPECT_EQ(check_frame(folder_ / name, wanted).condition, FrameCondition::kGood) << name;
    const auto in = OIIO::ImageInput::open((folder_ / name).string());
    ASSERT_TRUE(in) << OIIO::geterror();
    const std::string text(in->spec().get_string_attribute("ImageDescription"));
    EXPECT_THAT(text, testing::ContainsRegex("\ndigest: [0-9a-f]{32}\n$")) << name;
    EXPECT_THAT(text, testing::Not(testing::HasSubstr(std::string(kBlankDigest)))) << name;
  }
}

TEST_F(GradedFiles, OfAnotherKindIsRefused) {
  EXPECT_THROW(format_by_name("g.gif"), InputError);
  EXPECT_THROW(format_by_name("png"), InputError);
}

TEST(GreatestValue, IsFoundAtEveryPlaceAndLength) {
  std::mt19937 random(7);
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<unsigned short> values(count), magnitudes(count);
    for (std::size_t k = 0; k < count; ++k) {
      values[k] = static_cast<unsigned short>(random());
      magnitudes[k] = values[k] & 0x7fff;
    }
    const auto most = [](const std::vector<unsigned short>& of) {
      return of.empty() ? 0 : *std::ranges::max_element(of);
    };
    EXPECT_EQ(greatest_value(values.data(), count), most(values)) << count;
    EXPECT_EQ(greatest_magnitude(values.data(), count), most(magnitudes)) << count;
  }
}

}  // namespace
}  // namespace domefall
