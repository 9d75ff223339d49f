#include "pipeline/image/atomic_file.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "pipeline/image/errors.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using AtomicFile = TestFolder;

TEST_F(AtomicFile, AppearsWholeAndLeavesNothingElse) {
  write_atomically(folder_ / "a.bin", "new");
  write_atomically(folder_ / "a.bin", "newer");
  EXPECT_EQ(contents(folder_ / "a.bin"), "newer");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, AMissingFolderMayBeThereLaterAndIsNamed) {
  try {
    write_atomically(folder_ / "none" / "a.bin", "x");
    FAIL();
  } catch (const TemporaryError& error) {
    EXPECT_EQ(error.what(), (folder_ / "none/a.bin").string() + ": No such file or directory");
  }
}

// A limit on the size of files stands in for a full disk: it, too, lets a write begin and then
// refuses.  In a process of its own, which the limit does not outlive.
TEST_F(AtomicFile, AWriteThatBreaksOffLeavesTheOldFileAndNoTemporary) {
  write_atomically(folder_ / "a.bin", "old");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_atomically(folder_ / "a.bin", std::string(1'000'000, 'x'));
    } catch (const TemporaryError&) {
      _exit(75);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_EQ(contents(folder_ / "a.bin"), "old");
  EXPECT_EQ(file_count(), 1);
}

}  // namespace
}  // namespace domefall
