#include "pipeline/preview/file_watch.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/image/errors.h"
#include "pipeline/image/scratch_folder.h"

namespace domefall {
namespace {

constexpr int kLongWait = 60'000, kShort = 20;  // milliseconds

void write(const std::filesystem::path& file, const char* text) { std::ofstream(file) << text; }

TEST(FileWatch, SeesAFileThatIsWrittenAndOneThatTakesItsPlace) {
  const ScratchFolder folder;
  write(folder / "show.yaml", "one");
  FileWatch watch(folder / "show.yaml");
  EXPECT_FALSE(watch.wait(kShort));
  write(folder / "show.yaml", "two");
  EXPECT_TRUE(watch.wait(kLongWait));
  write(folder / "show.yaml~", "three");
  EXPECT_FALSE(watch.wait(kShort)) << "another file";
  std::filesystem::rename(folder / "show.yaml~", folder / "show.yaml");
  EXPECT_TRUE(watch.wait(kLongWait));
  EXPECT_FALSE(watch.wait(kShort));
}

TEST(FileWatch, SeesWhatALinkLeadsTo) {
  const ScratchFolder folder, other;
  write(other / "target.yaml", "one");
  std::filesystem::create_symlink(other / "target.yaml", folder / "show.yaml");
  FileWatch watch(folder / "show.yaml");
  write(other / "target.yaml", "two");
  EXPECT_TRUE(watch.wait(kLongWait));
}

TEST(FileWatch, SaysWhereItCannotWatch) {
  EXPECT_THROW(FileWatch("/nonexistent/show.yaml"), TemporaryError);
}

}  // namespace
}  // namespace domefall
