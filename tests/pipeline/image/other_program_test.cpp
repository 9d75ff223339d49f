// Frame files among those of other programs: what these read in ours, and what we make of theirs.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using testing::HasSubstr;

constexpr int kPictureWidth = 300, kPictureHeight = 200;

class OtherProgram : public TestFolder {
 protected:
  template <class Frame>
  static Frame gradient() {
    Frame frame(kPictureWidth, kPictureHeight);
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      frame.pixels[k] = static_cast<unsigned short>(k * 7 % 60000);
    return frame;
  }

  // By OpenImageIO alone.
  std::filesystem::path theirs(const char* name, OIIO::TypeDesc type, const void* pixels) const {
    const auto file = folder_ / name;
    const auto out = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(out &&
                out->open(file.string(), OIIO::ImageSpec(kPictureWidth, kPictureHeight, 3, type)) &&
                out->write_image(type, pixels) && out->close());
    return file;
  }
};

TEST_F(OtherProgram, ReadsTheColoursOfAFrame) {
  FrameInfo info;
  info.title = "Grüße, a \"title\"";
  write_frame(folder_ / "f.exr", gradient<HalfFrame>(), info);
  const auto in = OIIO::ImageInput::open((folder_ / "f.exr").string());
  ASSERT_TRUE(in) << OIIO::geterror();
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::HALF);
  EXPECT_EQ(in->spec().get_string_attribute("showTitle"), info.title);
  EXPECT_EQ(in->spec().get_string_attribute("colorSpace"), "ACEScg");
  const auto* chromaticities = in->spec().find_attribute("chromaticities");
  ASSERT_TRUE(chromaticities);
  // SMPTE ST 2065-1 and the Academy's S-2014-004: AP1 and the ACES white.
  const float ap1[] = {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f};
  for (int k = 0; k < 8; ++k) EXPECT_EQ(chromaticities->get_float_indexed(k), ap1[k]) << k;
  EXPECT_THAT(in->spec().channelnames, testing::ElementsAre("R", "G", "B"));
  EXPECT_FALSE(in->spec().find_attribute("DateTime"));
}

TEST_F(OtherProgram, ReadsHowAFrameWasGraded) {
  const GradedInfo info{"abc",  "Plongée",        42,           "Dome G2.2 Rec.709",
                        "Dome", "Domefall 0.1.0", "domemaster", {}};
  for (const char* name : {"g.png", "g.tif", "g.jpg"}) {
    write_graded(folder_ / name, gradient<GradedFrame>(), info, format_by_name(name));
    const auto in = OIIO::ImageInput::open((folder_ / name).string());
    ASSERT_TRUE(in) << OIIO::geterror();
    EXPECT_EQ(in->spec().format, name[2] == 'j' ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
    EXPECT_EQ(in->spec().nchannels, 3) << "no alpha in a delivery";
    const std::string lines(in->spec().get_string_attribute("ImageDescription"));
    for (const char* line : {"show: Plongée\n", "frame: 42\n", "display: Dome G2.2 Rec.709\n",
                             "view: Dome\n", "software: Domefall 0.1.0\n", "key: abc\n"})
      EXPECT_THAT(lines, HasSubstr(line)) << name;
  }
}

// Nor is the second in which a file is written of any interest.
TEST_F(OtherProgram, SeesNoTraceOfOurThreadsOrOurClock) {
  const auto write = [this](int threads, const std::string& name) {
    set_file_threads(threads);
    for (const char* kind : {"g.png", "g.tif", "g.jpg"})
      write_graded(folder_ / (name + kind), gradient<GradedFrame>(), {}, format_by_name(kind));
    write_frame(folder_ / (name + "g.exr"), gradient<HalfFrame>(), {});
    set_file_threads(0);
  };
  write(1, "a");
  write(4, "b");
  for (const std::string kind : {"g.png", "g.tif", "g.jpg", "g.exr"}) {
    EXPECT_TRUE(contents(folder_ / ("a" + kind)) == contents(folder_ / ("b" + kind))) << kind;
    const auto in = OIIO::ImageInput::open((folder_ / ("a" + kind)).string());
    ASSERT_TRUE(in) << OIIO::geterror();
    EXPECT_FALSE(in->spec().find_attribute("DateTime")) << kind;
  }
}

// Of the right size and whole, but with no key: neither ours to keep nor ours to replace.
TEST_F(OtherProgram, WritesNoFrameThatWeWouldKeepOrReplace) {
  const auto half = gradient<HalfFrame>();
  const auto exr = theirs("f.exr", OIIO::TypeDesc::HALF, half.pixels.data());
  const WantedFrame wanted{"", "", "", kPictureWidth, kPictureHeight};
  EXPECT_EQ(check_frame(exr, wanted).condition, FrameCondition::kOther);
  EXPECT_THAT(message_of([&] { read_frame(exr); }), HasSubstr(exr.string()));
  const auto words = gradient<GradedFrame>();
  for (const char* name : {"g.png", "g.tif"}) {
    const auto file = theirs(name, OIIO::TypeDesc::UINT16, words.pixels.data());
    EXPECT_EQ(check_frame(file, wanted).condition, FrameCondition::kOther) << name;
    EXPECT_EQ(check_frame(file, wanted).reason, "an image that is not Domefall's") << name;
  }
}

TEST_F(OtherProgram, SeesOnlyTheKeyWeMeantWhateverTheTitle) {
  GradedInfo info{.key = "22", .title = "x\nkey: 00\rkey: 11"};
  write_graded(folder_ / "g.tif", gradient<GradedFrame>(), info, {GradedKind::kTiff16});
  WantedFrame wanted{"22", info.title, "", kPictureWidth, kPictureHeight};
  EXPECT_EQ(check_frame(folder_ / "g.tif", wanted).condition, FrameCondition::kGood);
  wanted.key = "00";
  EXPECT_EQ(check_frame(folder_ / "g.tif", wanted).condition, FrameCondition::kOlder);
}

}  // namespace
}  // namespace domefall
