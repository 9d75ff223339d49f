// Frame files among those of other programs: what these read in ours, and what we make of theirs.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "pipeline/image/errors.h"
#include "pipeline/image/frame_condition.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 300, kHeight = 200;

class OtherProgram : public TestFolder {
 protected:
  template <class Frame>
  static Frame gradient() {
    Frame frame(kWidth, kHeight);
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      frame.pixels[k] = static_cast<unsigned short>(k * 7 % 60000);
    return frame;
  }

  // By OpenImageIO alone.
  std::filesystem::path theirs(const char* name, OIIO::TypeDesc type, const void* pixels) const {
    const auto file = folder_ / name;
    const auto out = OIIO::ImageOutput::create(file.string());
    EXPECT_TRUE(out && out->open(file.string(), OIIO::ImageSpec(kWidth, kHeight, 3, type)) &&
                out->write_image(type, pixels) && out->close());
    return file;
  }
};

TEST_F(OtherProgram, ReadsTheColoursOfAFrame) {
  write_frame(folder_ / "f.exr", gradient<HalfFrame>(), {});
  const auto in = OIIO::ImageInput::open((folder_ / "f.exr").string());
  ASSERT_TRUE(in) << OIIO::geterror();
  const auto* chromaticities = in->spec().find_attribute("chromaticities");
  ASSERT_TRUE(chromaticities);
  // SMPTE ST 2065-1 and the Academy's S-2014-004: AP1 and the ACES white.
  const float ap1[] = {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f};
  for (int k = 0; k < 8; ++k) EXPECT_EQ(chromaticities->get_float_indexed(k), ap1[k]) << k;
  EXPECT_THAT(in->spec().channelnames, testing::ElementsAre("R", "G", "B"));
  EXPECT_FALSE(in->spec().find_attribute("DateTime"));
}

TEST_F(OtherProgram, ReadsHowAFrameWasGraded) {
  const GradedInfo info{"abc",  "Plongée",        42,          "Dome G2.2 Rec.709",
                        "Dome", "Domefall 0.1.0", "domemaster"};
  for (const char* name : {"g.png", "g.tif"}) {
    write_graded(folder_ / name, gradient<GradedFrame>(), info);
    const auto in = OIIO::ImageInput::open((folder_ / name).string());
    ASSERT_TRUE(in) << OIIO::geterror();
    EXPECT_EQ(in->spec().format, OIIO::TypeDesc::UINT16);
    EXPECT_EQ(in->spec().nchannels, 3) << "no alpha in a delivery";
    const std::string lines(in->spec().get_string_attribute("ImageDescription"));
    for (const char* line : {"show: Plongée\n", "frame: 42\n", "display: Dome G2.2 Rec.709\n",
                             "view: Dome\n", "software: Domefall 0.1.0\n", "key: abc\n"})
      EXPECT_THAT(lines, HasSubstr(line)) << name;
  }
}

// OpenImageIO packs by threads of its own, and would note the second in which it writes.
TEST_F(OtherProgram, LeavesNoTraceOfItsThreadsOrItsClock) {
  const auto write = [this](int threads, const std::string& name) {
    OIIO::attribute("threads", threads);
    write_graded(folder_ / (name + ".png"), gradient<GradedFrame>(), {});
    write_graded(folder_ / (name + ".tif"), gradient<GradedFrame>(), {});
    write_frame(folder_ / (name + ".exr"), gradient<HalfFrame>(), {});
    OIIO::attribute("threads", 0);
  };
  write(1, "a");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write(4, "b");
  for (const char* kind : {".png", ".tif", ".exr"})
    EXPECT_TRUE(contents(folder_ / (std::string("a") + kind)) ==
                contents(folder_ / (std::string("b") + kind)))
        << kind;
}

// Of the right size and whole, but with no key: neither ours to keep nor ours to replace.
TEST_F(OtherProgram, WritesNoFrameThatWeWouldKeepOrReplace) {
  const auto half = gradient<HalfFrame>();
  const auto exr = theirs("f.exr", OIIO::TypeDesc::HALF, half.pixels.data());
  const WantedFrame wanted{"", "", "", kWidth, kHeight};
  EXPECT_EQ(examine_frame(exr, wanted), FrameCondition::kOther);
  EXPECT_THAT([&] { read_frame(exr); },
              testing::ThrowsMessage<InputError>(HasSubstr(exr.string())));
  const auto words = gradient<GradedFrame>();
  for (const char* name : {"g.png", "g.tif"}) {
    const auto file = theirs(name, OIIO::TypeDesc::UINT16, words.pixels.data());
    EXPECT_EQ(examine_frame(file, wanted), FrameCondition::kOther) << name;
    EXPECT_EQ(describe_difference(file, wanted), "an image that is not Domefall's") << name;
  }
}

TEST_F(OtherProgram, SeesOnlyTheKeyWeMeantWhateverTheTitle) {
  GradedInfo info;
  info.title = "x\nkey: 00\rkey: 11";
  info.key = "22";
  write_graded(folder_ / "g.tif", gradient<GradedFrame>(), info);
  WantedFrame wanted{"22", info.title, "", kWidth, kHeight};
  EXPECT_EQ(examine_frame(folder_ / "g.tif", wanted), FrameCondition::kGood);
  wanted.key = "00";
  EXPECT_EQ(examine_frame(folder_ / "g.tif", wanted), FrameCondition::kOlder);
}

}  // namespace
}  // namespace domefall
