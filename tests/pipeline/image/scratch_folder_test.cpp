#include "pipeline/image/scratch_folder.h"

#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>

#include "pipeline/image/errors.h"
#include "pipeline/image/unfinished.h"
#include "pipeline/image/writer_id.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// With $TMPDIR in the test's own folder.
class Scratch : public TestFolder {
 protected:
  Scratch() {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder_.c_str(), 1);
  }
  ~Scratch() override {
    if (before_)
      setenv("TMPDIR", before_->c_str(), 1);
    else
      unsetenv("TMPDIR");
  }

  // A child that ends as a killed one does, without cleaning up.
  static pid_t killed_child(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
      body();
      _exit(0);
    }
    waitpid(child, nullptr, 0);
    return child;
  }

  // What the next scratch folder leaves of those before.
  int left_by_the_next() const {
    { const ScratchFolder next; }
    return file_count();
  }

 private:
  std::optional<std::string> before_;
};

TEST_F(Scratch, IsThereForAsLongAsItLivesAndNobodyElseMayEnter) {
  {
    const ScratchFolder folder, other;
    EXPECT_NE(folder / "", other / "");
    struct stat status {};
    ASSERT_EQ(stat((folder / "").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode, S_IFDIR | 0700U);
    put(folder / "a", "x");
    EXPECT_EQ(file_count(), 2);
  }
  EXPECT_EQ(file_count(), 0);
}

TEST_F(Scratch, OfAKilledProgramIsRemovedByTheNextAndThatOfALivingOneIsNot) {
  const ScratchFolder living;
  put(living / "a", "x");
  killed_child([] {
    const ScratchFolder folder;
    put(folder / "a", "x");
    _exit(0);
  });
  EXPECT_EQ(file_count(), 2);
  EXPECT_EQ(left_by_the_next(), 1);
  EXPECT_TRUE(fs::exists(living / "a"));
}

TEST_F(Scratch, TakesNothingThatIsNotExactlyItsOwn) {
  WriterId dead = this_writer();
  dead.device = device_of(folder_);
  dead.process = killed_child([] {});
  const std::string id = text_of(dead);
  fs::create_directory(folder_ / "target");
  put(folder_ / "target" / "a", "x");
  fs::create_directory_symlink("target", folder_ / (id + "-abcdef"));
  put(folder_ / (id + "-ABCDEF"), "a file");
  for (const std::string& name : {std::string("domefall_check_999998"), id, id + "-abcde",
                                  id + "-abcdefg", "x" + id + "-abcdef"})
    fs::create_directory(folder_ / name);
  EXPECT_EQ(left_by_the_next(), 8);
  EXPECT_TRUE(fs::exists(folder_ / "target" / "a"));
  fs::create_directory(folder_ / (id + "-123456"));
  EXPECT_EQ(left_by_the_next(), 8);
}

TEST_F(Scratch, OfAnotherUserIsLeft) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  WriterId dead = this_writer();
  dead.process = killed_child([] {});
  const fs::path theirs = folder_ / (text_of(dead) + "-abcdef");
  fs::create_directory(theirs);
  ASSERT_EQ(chown(theirs.c_str(), 65534, 65534), 0);
  EXPECT_EQ(left_by_the_next(), 1);
}

TEST_F(Scratch, WhereThereIsNoTemporaryFolderIsForLater) {
  setenv("TMPDIR", (folder_ / "none").c_str(), 1);
  EXPECT_THROW(ScratchFolder(), TemporaryError);
}

// As when a signal ends the program in the middle.
TEST_F(Scratch, IsRemovedWithAllThatIsUnfinished) {
  killed_child([] {
    const ScratchFolder folder;
    put(folder / "a", "x");
    remove_unfinished();
    _exit(0);
  });
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace domefall
