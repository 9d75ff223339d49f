// What a frame's file is found to be, and what follows for the frame.
#include "pipeline/render/frames/frame_findings.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <limits>

#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frames/brightest_value.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using enum FrameCondition;

constexpr int kWidth = 5, kHeight = 3;

WantedFrame wanted_frame(char key = 'a') {
  return {std::string(32, key), "A fall", "domemaster", kWidth, kHeight};
}

FrameInfo linear_info(char key = 'a') {
  FrameInfo info;
  info.title = "A fall", info.projection = "domemaster", info.key = std::string(32, key);
  return info;
}

class FileFindings : public TestFolder {
 protected:
  // A linear frame in which one value is `brightest` and the others are 0.
  ExpectedFile linear(float brightest) const {
    FloatImage frame(kWidth, kHeight);
    frame.pixels[7] = brightest;
    write_frame(file_.path, frame, linear_info());
    return file_;
  }
  ExpectedFile graded(unsigned short brightest) const {
    const ExpectedFile file{3, folder_ / "f.png", "f.png", wanted_frame()};
    GradedFrame frame(kWidth, kHeight);
    frame.pixels[7] = brightest;
    const std::string key(32, 'a');
    write_graded(file.path, frame, {key, "A fall", 3, "", "", "Domefall", "domemaster", {}},
                 format_by_name("f.png"));
    return file;
  }
  // A manifest that has the file as it lies there.
  static Manifest manifest_of(const ExpectedFile& file, double brightest) {
    struct stat status {};
    EXPECT_EQ(stat(file.path.c_str(), &status), 0);
    const auto bytes = FileBytes::open(file.path);
    Manifest manifest;
    manifest.files[file.name].push_back(
        {file.frame, file.name, bytes->size(),
         status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec,
         read_frame_head(*bytes)->digest, file.wanted.key, 1, brightest, "host", 1});
    return manifest;
  }

  ExpectedFile file_{3, folder_ / "f.exr", "f.exr", wanted_frame()};
};

TEST_F(FileFindings, OfAGoodFrameAreTheSameAtAGlanceAndByAllBytes) {
  const ExpectedFile file = linear(0.5F);
  for (const Manifest& manifest : {Manifest(), manifest_of(file, 0.5)})
    for (const auto look : {glance_at, examine_file}) {
      const FileFinding found = look(file, manifest);
      EXPECT_EQ(found.condition, kGood);
      EXPECT_FALSE(found.black || found.not_finite || found.unlike) << found.reason;
    }
}

TEST_F(FileFindings, TellABlackFrameOfTheRightDigest) {
  EXPECT_TRUE(examine_file(linear(0), {}).black);
  EXPECT_TRUE(examine_file(linear(1e-4F), {}).black);
  EXPECT_FALSE(examine_file(linear(1e-2F), {}).black);
  EXPECT_TRUE(examine_file(graded(0), {}).black);
  EXPECT_TRUE(examine_file(graded(257), {}).black);
  EXPECT_FALSE(examine_file(graded(2000), {}).black);
  // The writer's word counts only for the very bytes.
  Manifest manifest = manifest_of(linear(0.5F), 0.5);
  EXPECT_TRUE(examine_file(linear(0), manifest).black);
  EXPECT_TRUE(examine_file(linear(0), manifest).unlike);
  manifest = manifest_of(linear(0), 0);
  EXPECT_TRUE(examine_file(file_, manifest).black);
  EXPECT_FALSE(examine_file(file_, manifest).unlike);
}

TEST_F(FileFindings, TellValuesThatAreNoNumbers) {
  for (const float value :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
        -std::numeric_limits<float>::infinity()})
    EXPECT_TRUE(examine_file(linear(value), {}).not_finite) << value;
  EXPECT_FALSE(examine_file(linear(65504), {}).not_finite);
}

TEST_F(FileFindings, TellEveryFlippedBitByAllBytesAndAnotherLengthAtAGlance) {
  const ExpectedFile file = linear(0.5F);
  const Manifest manifest = manifest_of(file, 0.5);
  const std::string whole = contents(file.path);
  for (std::size_t k = whole.size() - 40; k < whole.size(); ++k) {
    std::string flipped = whole;
    flipped[k] = static_cast<char>(flipped[k] ^ 4);
    put(file.path, flipped);
    EXPECT_EQ(examine_file(file, manifest).condition, kDamaged) << k;
  }
  put(file.path, whole + "x");
  EXPECT_EQ(examine_file(file, manifest).condition, kDamaged);
  EXPECT_EQ(glance_at(file, manifest).condition, kDamaged);
  put(file.path, whole.substr(0, whole.size() / 2));
  EXPECT_EQ(glance_at(file, {}).condition, kDamaged);
}

TEST_F(FileFindings, TellOtherVersionsAndWhatCannotBeRead) {
  ExpectedFile file = linear(0.5F);
  const Manifest manifest = manifest_of(file, 0.5);
  file.wanted = wanted_frame('b');
  EXPECT_EQ(glance_at(file, manifest).condition, kOlder);
  EXPECT_EQ(examine_file(file, manifest).condition, kOlder);
  file.wanted.title = "Another";
  EXPECT_EQ(glance_at(file, manifest).condition, kOther);
  fs::remove(file.path);
  EXPECT_EQ(glance_at(file, manifest).condition, kMissing);
  EXPECT_EQ(examine_file(file, manifest).condition, kMissing);
  fs::create_directory(file.path);
  EXPECT_THAT(glance_at(file, manifest).reason, testing::HasSubstr("f.exr"));
  EXPECT_THAT(examine_file(file, manifest).reason, testing::HasSubstr("f.exr"));
}

TEST(BrightestValue, IsOfAllValuesWithoutTheirSigns) {
  HalfFrame frame(3, 2);
  EXPECT_EQ(brightest_value(frame), 0);
  frame.pixels[4] = Imath::half(-2.5F);
  frame.pixels[9] = Imath::half(2.0F);
  EXPECT_EQ(brightest_value(frame), 2.5);
  frame.pixels[17] = Imath::half::qNan();
  EXPECT_EQ(brightest_value(frame), std::numeric_limits<double>::infinity());
}

FileFinding as(FrameCondition condition) { return {{condition}}; }

// One file of each kind for frames 0 to 6, found to be...
TEST(FolderFindingsSums, PutEachFrameIntoTheWorstOfItsLists) {
  std::vector<ExpectedFile> files;
  std::vector<FileFinding> findings;
  const auto add = [&](int frame, FileFinding linear, FileFinding graded) {
    for (const char* name : {"linear/f.exr", "graded/f.png"})
      files.push_back({frame, name, name, wanted_frame()});
    findings.push_back(std::move(linear));
    findings.push_back(std::move(graded));
  };
  FileFinding black = as(kGood);
  black.black = true;
  add(0, as(kGood), as(kGood));
  add(1, as(kGood), as(kMissing));
  add(2, as(kOlder), as(kDamaged));
  add(3, as(kOlder), as(kGood));
  add(4, as(kGood), as(kOlder));
  add(5, as(kOther), as(kUnreadable));
  add(6, as(kOther), as(kOlder));
  add(7, as(kGood), black);
  const FolderFindings found = sum_up(files, findings);
  EXPECT_THAT(found.frames, ElementsAre(ElementsAre(5), ElementsAre(1), ElementsAre(2),
                                        ElementsAre(6), ElementsAre(3, 4), ElementsAre(0, 7)));
  EXPECT_THAT(found.older_linear, ElementsAre(2, 3));
  EXPECT_THAT(found.older_graded, ElementsAre(4, 6));
  ASSERT_EQ(found.others.size(), 1U);
  EXPECT_EQ(found.others.front().name, "linear/f.exr");
  EXPECT_THAT(found.black_graded, ElementsAre(7));
  EXPECT_THAT(found.black_linear, IsEmpty());
  EXPECT_THAT(found.to_make(), ElementsAre(1, 2, 3, 4, 6));
}

}  // namespace
}  // namespace domefall
