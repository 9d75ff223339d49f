// What the manifests of several processes say, torn or whole.
#include "pipeline/render/frames/manifest.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "pipeline/base/writer_id.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

constexpr const char* kKey = "0123456789abcdef0123456789abcdef";

MadeFile made_file(int frame, std::int64_t mtime_ns) {
  return {frame, "linear/a.exr", 7, mtime_ns, "d", "k", 1.5, 0.25, "host", 42};
}

class ManifestFiles : public TestFolder {
 protected:
  ManifestFiles() { fs::create_directories(manifest_folder(folder_)); }

  // The manifest of a process of another machine, of which nobody knows whether it lives.
  void put_manifest(pid_t process, const std::string& text) const {
    WriterId id;
    id.boot = 1, id.process = process, id.start = 1;
    put(manifest_folder(folder_) / (text_of(id) + ".jsonl"), text);
  }
};

TEST(ManifestLines, AreReadBackAsTheyWereWritten) {
  const MadeFile made{
      7, "linear/a\n\"ü.exr", 1ULL << 40, 1'700'000'000'123'456'789, "d", "k", 1.25, 0.1, "node-3",
      99};
  const auto line = parse_manifest_line(text_of(made));
  ASSERT_TRUE(line && line->made);
  EXPECT_EQ(line->made->file, made.file);
  EXPECT_EQ(line->made->size, made.size);
  EXPECT_EQ(line->made->mtime_ns, made.mtime_ns);
  EXPECT_EQ(line->made->brightest, made.brightest);
  const auto begun = parse_manifest_line(text_of(BegunFrame{3, 1.5e9, "node-3", 99}));
  ASSERT_TRUE(begun && begun->begun && !begun->made);
  EXPECT_EQ(begun->begun->frame, 3);
  EXPECT_EQ(text_of(made).find('\n'), text_of(made).size() - 1);
}

TEST(ManifestLines, AreNothingWhereTheyAreTorn) {
  for (const std::string& whole :
       {text_of(made_file(1, 2)), text_of(BegunFrame{3, 1.5e9, "node-3", 99})})
    for (std::size_t length = 0; length + 1 < whole.size(); ++length)
      EXPECT_FALSE(parse_manifest_line(whole.substr(0, length))) << length;
  for (const char* other : {"[]", "{}", "7", "null", R"({"frame":"x","begun_s":1})", "\xff"})
    EXPECT_FALSE(parse_manifest_line(other)) << other;
}

TEST_F(ManifestFiles, AreMergedAndWhatIsTornIsLeftOut) {
  const std::string first = text_of(made_file(1, 20));
  put_manifest(1, first + first.substr(0, 30) + "\n" + text_of(BegunFrame{5, 100, "here", 11}));
  put_manifest(2, std::string(3, '\0') + "\n" + text_of(BegunFrame{1, 90, "there", 12}) +
                      text_of(made_file(1, 30)) +
                      text_of(BegunFrame{6, 95, "there", 12}).substr(0, 9));
  put(manifest_folder(folder_) / "notes.jsonl", first);
  const Manifest manifest = read_manifest(folder_, 2);
  ASSERT_THAT(manifest.writers, SizeIs(2));
  EXPECT_THAT(manifest.writers[0].being_made, ElementsAre(Pair(5, 100)));
  EXPECT_THAT(manifest.writers[1].being_made, IsEmpty());
  EXPECT_THAT(manifest.writers[1].finished, ElementsAre(30));
  EXPECT_FALSE(manifest.writers[0].ended);
  EXPECT_THAT(manifest.files.at("linear/a.exr"), SizeIs(2));
  ASSERT_TRUE(manifest.find("linear/a.exr", 7, 30));
  EXPECT_FALSE(manifest.find("linear/a.exr", 8, 30));
  EXPECT_TRUE(manifest.find("linear/a.exr", "d"));
  EXPECT_FALSE(manifest.find("linear/b.exr", "d"));
}

TEST_F(ManifestFiles, AreWrittenWhereAFarmIsAndSayWhatTheFileIs) {
  const fs::path path = folder_ / "f.png";
  GradedFrame frame(4, 4);
  write_graded(path, frame, {kKey, "A fall", 7, "Wall", "Wall", "Domefall", "domemaster", {}},
               format_by_name("f.png"));
  {
    ManifestWriter writer(folder_);
    writer.begin(7);
    const Manifest during = read_manifest(folder_, 1);
    ASSERT_THAT(during.writers, SizeIs(1));
    EXPECT_FALSE(during.writers[0].ended);
    EXPECT_THAT(during.writers[0].being_made, ElementsAre(Pair(7, testing::Gt(1e9))));
    writer.made(7, path, 0.5, 0.75);
  }
  const Manifest manifest = read_manifest(folder_, 1);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  const MadeFile* made =
      manifest.find("f.png", static_cast<std::uint64_t>(status.st_size),
                    status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->key, kKey);
  EXPECT_EQ(made->digest.size(), 32U);
  EXPECT_EQ(made->brightest, 0.75);
  EXPECT_THAT(manifest.writers[0].being_made, IsEmpty());
}

TEST_F(ManifestFiles, AreNotWrittenWhereNoFarmIs) {
  fs::remove_all(folder_ / "farm");
  ManifestWriter writer(folder_);
  EXPECT_FALSE(writer.is_on());
  writer.begin(7);
  EXPECT_EQ(file_count(), 0);
  EXPECT_THAT(read_manifest(folder_, 1).writers, IsEmpty());
}

TEST_F(ManifestFiles, ThatCannotBeReadAreLeftOut) {
  const fs::path good = manifest_folder(folder_) / (text_of(this_writer()) + ".jsonl");
  WriterId other = this_writer();
  other.start += 1;
  const fs::path bad = manifest_folder(folder_) / (text_of(other) + ".jsonl");
  put(good, text_of(BegunFrame{5, 100, "here", 1}));
  fs::create_symlink("nowhere", bad);
  EXPECT_THAT(read_manifest(folder_, 2).writers, SizeIs(1));
  fs::remove(bad);
  fs::create_directory(bad);
  EXPECT_THAT(read_manifest(folder_, 2).writers, SizeIs(1));
}

// What a process began that has ended is not being made any more.
TEST_F(ManifestFiles, OfTheDeadSayThatNothingIsBeingMade) {
  WriterId id = this_writer();
  if (id.boot == 0) GTEST_SKIP() << "the kernel's boot id is not known here";
  id.start += 1;  // another process had this number before
  put(manifest_folder(folder_) / (text_of(id) + ".jsonl"), text_of(BegunFrame{5, 100, "here", 1}));
  const Manifest manifest = read_manifest(folder_, 1);
  ASSERT_THAT(manifest.writers, SizeIs(1));
  EXPECT_TRUE(manifest.writers[0].ended);
  EXPECT_THAT(manifest.writers[0].being_made, IsEmpty());
}

}  // namespace
}  // namespace domefall
