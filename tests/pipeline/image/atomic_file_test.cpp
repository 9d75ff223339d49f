#include "pipeline/image/atomic_file.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "pipeline/image/errors.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

// This host as temporaries bear it.
std::string host_in_names() {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  std::string name(host);
  for (char& c : name)
    if (c == '.') c = '-';
  return name;
}

using AtomicFile = TestFolder;

TEST_F(AtomicFile, AppearsWholeAndLeavesNothingElse) {
  write_atomically(folder_ / "a.bin", "new");
  write_atomically(folder_ / "a.bin", "newer");
  EXPECT_EQ(contents(folder_ / "a.bin"), "newer");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, AMissingFolderIsTheUsersToMendAndNamed) {
  try {
    write_atomically(folder_ / "none" / "a.bin", "x");
    FAIL();
  } catch (const InputError& error) {
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

TEST_F(AtomicFile, SweepingTakesOnlyWhatTheDeadLeft) {
  const std::string name = host_in_names();
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);  // a number that is in nobody's use now
  const std::string dead = ".a_00001.exr." + name + "." + std::to_string(child) + ".1-0.tmp",
                    living = ".a_00002.exr." + name + "." + std::to_string(getpid()) + ".1-0.tmp",
                    foreign = ".a_00003.exr.elsewhere.1.1-0.tmp";
  for (const std::string& file : {dead, living, foreign, std::string("a.tmp"), std::string(".b")})
    put(folder_ / file, "x");
  EXPECT_EQ(sweep_temporaries(folder_), 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / dead));
  EXPECT_EQ(file_count(), 4);
  std::filesystem::last_write_time(
      folder_ / foreign, std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_EQ(sweep_temporaries(folder_), 1);
  EXPECT_EQ(sweep_temporaries(folder_ / "none"), 0);
}

TEST_F(AtomicFile, SweepingTakesWhatAZombieLeft) {
  const std::string name = host_in_names();
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t info;
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // ended, not reaped
  put(folder_ / (".a.exr." + name + "." + std::to_string(child) + ".1-0.tmp"), "x");
  EXPECT_EQ(sweep_temporaries(folder_), 1);
  waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace domefall
