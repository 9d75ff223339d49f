// What a file among the frames is taken for, and that no damage to it goes unseen.
#include "pipeline/image/frame_check.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <array>
#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_head.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kFrameWidth = 5, kFrameHeight = 3;
constexpr std::array kNames{"f.exr", "f.png", "f.tif", "f.jpg"};

WantedFrame wanted_frame() {
  return {"0123456789abcdef0123456789abcdef", "A fall", "domemaster", kFrameWidth, kFrameHeight};
}

class FrameChecks : public TestFolder {
 protected:
  // A frame of that key, title, projection and size under that name.
  fs::path made(const char* name, const WantedFrame& w = wanted_frame()) const {
    const fs::path path = folder_ / name;
    if (path.extension() == ".exr") {
      FrameInfo info;
      info.key = w.key, info.title = w.title, info.projection = w.projection;
      info.region = "I", info.software = "Domefall 0.1.0";
      write_frame(path, filled<HalfFrame>(w), info);
    } else {
      write_graded(path, filled<GradedFrame>(w),
                   {w.key, w.title, 7, "Wall", "Wall", "Domefall 0.1.0", w.projection, {}},
                   format_by_name(name));
    }
    return path;
  }

  static FrameCondition condition(const fs::path& path) {
    return check_frame(path, wanted_frame()).condition;
  }

 private:
  template <class Frame>
  static Frame filled(const WantedFrame& w) {
    Frame frame(w.width, w.height);
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      frame.pixels[k] = static_cast<unsigned short>(k * 7919 % 31744);
    return frame;
  }
};

// A frame with a changed key is one of another version, and is made again as a damaged one is.
bool is_made_again(FrameCondition condition) {
  return condition == FrameCondition::kDamaged || condition == FrameCondition::kOlder;
}

TEST_F(FrameChecks, KnowEveryFlippedBit) {
  for (const char* name : kNames) {
    const fs::path path = made(name);
    ASSERT_EQ(condition(path), FrameCondition::kGood);
    const std::string whole = contents(path);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto set = [&file](std::size_t at, char byte) {
      file.seekp(static_cast<std::streamoff>(at)).put(byte).flush();
    };
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        set(at, static_cast<char>(whole[at] ^ 1 << bit));
        EXPECT_TRUE(is_made_again(condition(path))) << name << ", byte " << at << ", bit " << bit;
      }
      set(at, whole[at]);
    }
    EXPECT_EQ(condition(path), FrameCondition::kGood);
  }
}

TEST_F(FrameChecks, KnowEveryCutAndEveryThingAdded) {
  for (const char* name : kNames) {
    const fs::path path = made(name);
    const std::string whole = contents(path);
    for (std::size_t length = whole.size(); length-- > 0;) {
      fs::resize_file(path, length);
      EXPECT_EQ(condition(path), FrameCondition::kDamaged) << name << ", cut at " << length;
      EXPECT_FALSE(is_whole(path));
    }
    for (const std::string& more : {std::string(1, '\0'), std::string("x"), whole}) {
      put(path, whole + more);
      EXPECT_EQ(condition(path), FrameCondition::kDamaged) << name << " and " << more.size();
    }
  }
}

TEST_F(FrameChecks, TellAFrameOfAnotherSizeShowOrProjectionFromAnOlderOne) {
  const auto other = [](auto change) {
    WantedFrame w = wanted_frame();
    w.key = "ffffffffffffffffffffffffffffffff";
    change(w);
    return w;
  };
  for (const char* name : kNames) {
    EXPECT_EQ(condition(made(name, other([](auto&) {}))), FrameCondition::kOlder) << name;
    for (const auto& [frame, what] : {
             std::pair(other([](auto& w) { w.width = 9; }), "9 x 3 pixels"),
             std::pair(other([](auto& w) { w.title = "A rise"; }), "of the show 'A rise'"),
             std::pair(other([](auto& w) { w.projection = "flat"; }), "of the projection flat"),
         }) {
      const fs::path path = made(name, frame);
      EXPECT_EQ(condition(path), FrameCondition::kOther) << name;
      const FrameCheck by_head = check_frame(path, wanted_frame(), CheckDepth::kHead);
      EXPECT_EQ(by_head.condition, FrameCondition::kOther) << name;
      EXPECT_EQ(by_head.reason, what) << name;
      // A damaged one is nobody's loss.
      put(path, contents(path) + "x");
      EXPECT_EQ(condition(path), FrameCondition::kDamaged) << name;
    }
    EXPECT_EQ(condition(folder_ / "none.exr"), FrameCondition::kMissing);
  }
}

TEST_F(FrameChecks, KnowAFormatBehindAnothersName) {
  for (const auto& [from, to] :
       {std::pair("f.exr", "g.png"), std::pair("f.png", "g.tif"), std::pair("f.tif", "g.exr"),
        std::pair("f.jpg", "g.png"), std::pair("f.tif", "g.jpg")}) {
    fs::copy_file(made(from), folder_ / to, fs::copy_options::overwrite_existing);
    EXPECT_EQ(condition(folder_ / to), FrameCondition::kOther) << to;
  }
}

// Nobody asked for them to be replaced.
TEST_F(FrameChecks, TakeAFileOfAnotherKindForAnothers) {
  using std::string_literals::operator""s;
  const std::string rest(2000, 'x');
  for (const char* name : {"f.exr", "f.png", "f.tif"})
    for (const std::string& start : {"no image"s, "v"s + "iew"s, "\xff\xd8\xff\xe0\0\x10JFIF"s,
                                     "II+\0\x08\0\0\0"s, "MM\0+\0\x08\0\0"s, "GIF89a"s, "RIFF"s}) {
      put(folder_ / name, start + rest);
      EXPECT_EQ(condition(folder_ / name), FrameCondition::kOther) << name << ", " << start;
      const FrameCheck by_head = check_frame(folder_ / name, wanted_frame(), CheckDepth::kHead);
      EXPECT_EQ(by_head.condition, FrameCondition::kOther);
      EXPECT_EQ(by_head.reason, "a file that is not Domefall's");
    }
  // Another program's OpenEXR with a compression of a later version.
  std::string exr = contents(made("f.exr"));
  for (const char* field : {"frameKey", "fileDigest", "showTitle"})
    exr.replace(exr.find(field), 2, "zz");
  exr[exr.find("compression\0compression"s) + 12 + 12 + 4] = 11;
  put(folder_ / "f.exr", exr);
  EXPECT_EQ(condition(folder_ / "f.exr"), FrameCondition::kOther);
}

TEST_F(FrameChecks, TakeWhatIsLeftOfAFrameForDamaged) {
  for (const char* name : kNames) {
    const std::string whole = contents(made(name));
    std::string no_start = whole, no_head = whole;
    no_start.replace(0, 8, "xxxxxxxx");
    no_head.replace(0, whole.size(), whole.size(), '\0');
    for (const std::string& left : {std::string(), no_start, no_head}) {
      put(folder_ / name, left);
      EXPECT_EQ(condition(folder_ / name), FrameCondition::kDamaged) << name << left.size();
    }
  }
}

// The header that a decoder would ask for 21 GB for.
TEST_F(FrameChecks, TakeALyingHeaderForDamaged) {
  const fs::path path = made("f.exr");
  std::string lying = contents(path);
  const std::int32_t last = 59'999;
  for (const char* window : {"dataWindow", "displayWindow"})
    for (const std::size_t edge : {8U, 12U}) {
      const std::size_t at = lying.find(window) + std::strlen(window) + sizeof "box2i" + 5 + edge;
      std::memcpy(&lying[at], &last, sizeof last);
    }
  put(path, lying);
  EXPECT_EQ(condition(path), FrameCondition::kDamaged);
  EXPECT_THROW(read_frame(path), InputError);
  // Nor does it become another program's by losing what is ours.
  for (const char* field : {"frameKey", "fileDigest", "showTitle"})
    lying.replace(lying.find(field), 2, "zz");
  put(path, lying);
  EXPECT_EQ(condition(path), FrameCondition::kDamaged);
}

// Its digest's name is gone, and so is what it was.
TEST_F(FrameChecks, TakeAFrameWithoutADigestForDamaged) {
  const fs::path path = made("f.exr");
  std::string without = contents(path);
  without.replace(without.find("fileDigest"), 2, "zz");
  put(path, without);
  EXPECT_EQ(condition(path), FrameCondition::kDamaged);
  EXPECT_FALSE(is_whole(path));
}

// None of them is opened, replaced or waited for.
TEST_F(FrameChecks, RefuseWhatIsNoFile) {
  const fs::path path = folder_ / "f.exr";
  const auto refused = [&](const std::string& why) {
    for (const CheckDepth depth : {CheckDepth::kHead, CheckDepth::kWhole})
      EXPECT_THAT(message_of([&] { check_frame(path, wanted_frame(), depth); }),
                  HasSubstr(path.string() + ": " + why));
    fs::remove(path);
  };
  fs::create_directory(path);
  refused("this is a folder");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  refused("this is a pipe");
  fs::create_symlink("/dev/null", path);
  refused("this is a device");
  fs::create_symlink(path, path);
  refused("Too many levels of symbolic links");
  fs::create_symlink(folder_ / "elsewhere.exr", path);
  EXPECT_THAT(message_of<TemporaryError>([&] { condition(path); }), HasSubstr("leads nowhere"));
  fs::rename(made("g.exr"), folder_ / "elsewhere.exr");
  EXPECT_EQ(condition(path), FrameCondition::kGood);
}

TEST(FrameHead, SaysSizeAndBitsOfEveryKind) {
  const ScratchFolder folder;
  GradedInfo info{.key = "0123", .title = "A show"};
  for (const auto& [kind, name, bits] : {std::tuple{GradedKind::kPng16, "a.png", 16},
                                         {GradedKind::kPng8, "b.png", 8},
                                         {GradedKind::kTiff16, "a.tif", 16},
                                         {GradedKind::kTiff8, "b.tif", 8},
                                         {GradedKind::kJpeg, "a.jpg", 8}}) {
    write_graded(folder / name, GradedFrame(24, 16), info, {kind});
    const auto head = read_frame_head(*FileBytes::open(folder / name));
    ASSERT_TRUE(head) << name;
    EXPECT_EQ(head->bits, bits) << name;
    EXPECT_EQ(head->width, 24) << name;
    EXPECT_EQ(head->height, 16) << name;
    EXPECT_EQ(head->key, "0123") << name;
    EXPECT_EQ(head->title, "A show") << name;
  }
}

}  // namespace
}  // namespace domefall
