// Which temporaries and scratch folders a sweep takes, and which it must leave.
#include "pipeline/base/temporary_file.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>

#include "pipeline/base/errors.h"
#include "pipeline/base/writer_id.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Runs `body` in a process of its own, which ends as a killed one does, without cleaning up if it
// calls _exit().  Returns that process's number.
pid_t in_a_child(const std::function<void()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    body();
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  return child;
}

class Temporary : public TestFolder {
 protected:
  fs::path name(const WriterId& writer) const {
    return folder_ / (".a_00001.exr." + text_of(writer) + "-0.tmp");
  }

  // As if a writer had left it, who holds no lock.
  fs::path leave(const WriterId& writer) const {
    put(name(writer), "x");
    return name(writer);
  }

  fs::path leave_aged(const WriterId& writer, std::chrono::hours age) const {
    fs::path file = leave(writer);
    fs::last_write_time(file, fs::file_time_type::clock::now() - age);
    return file;
  }

  // This process as it would sign files here.
  WriterId here() const {
    WriterId writer = this_writer();
    writer.device = device_of(folder_);
    return writer;
  }

  // A process of this namespace that has ended.
  WriterId dead() const {
    WriterId writer = here();
    writer.process = in_a_child([] {});
    return writer;
  }

  void expect_swept(const fs::path& file) const {
    EXPECT_EQ(sweep_temporaries(folder_), 1) << file;
    EXPECT_FALSE(fs::exists(file)) << file;
  }

  void expect_kept(const fs::path& file) const {
    EXPECT_EQ(sweep_temporaries(folder_), 0) << file;
    EXPECT_TRUE(fs::remove(file)) << file;
  }
};

constexpr auto kOld = std::chrono::hours(24 * 365);

TEST_F(Temporary, OfALivingWriterIsKeptHoweverOldItIs) {
  const TemporaryFile file(folder_ / "a.exr");
  const fs::path path = fs::directory_iterator(folder_)->path();
  fs::last_write_time(path, fs::file_time_type::clock::now() - kOld);
  EXPECT_EQ(sweep_temporaries(folder_), 0);
  EXPECT_TRUE(fs::exists(path));
}

TEST_F(Temporary, OfADeadWriterIsSweptAtOnce) {
  in_a_child([this] {
    const TemporaryFile file(folder_ / "a.exr");
    _exit(0);  // as a kill: nothing is cleaned up
  });
  ASSERT_EQ(file_count(), 1);
  expect_swept(fs::directory_iterator(folder_)->path());
}

TEST_F(Temporary, OfAZombieIsSweptAtOnce) {
  const pid_t child = fork();
  if (child == 0) {
    const TemporaryFile file(folder_ / "a.exr");
    _exit(0);
  }
  siginfo_t info;
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // ended, not reaped
  EXPECT_EQ(sweep_temporaries(folder_), 1);
  waitpid(child, nullptr, 0);
}

// A container's first process is number 1 in every container and after every start of one.
TEST_F(Temporary, OfANamesakeInAnotherPidNamespaceIsJudgedByItsLock) {
  WriterId namesake = here();
  ++namesake.process_namespace;
  expect_swept(leave(namesake));
  namesake.process = 1;
  expect_swept(leave(namesake));
  const TemporaryFile living(folder_ / "a.exr");
  fs::rename(fs::directory_iterator(folder_)->path(), name(namesake));
  EXPECT_EQ(sweep_temporaries(folder_), 0);
  EXPECT_TRUE(fs::exists(name(namesake)));
}

TEST_F(Temporary, OfAnEarlierProcessWithTheSameNumberIsSwept) {
  WriterId earlier = here();
  --earlier.start;
  expect_swept(leave(earlier));
}

// Some file servers know no locks, and a lock on one mount of a server is not seen on another.
TEST_F(Temporary, WithoutALockIsJudgedByItsProcessOrByAge) {
  WriterId unlocked = here();
  for (const std::uint64_t device : {std::uint64_t{0}, unlocked.device + 1}) {
    unlocked.device = device;
    expect_kept(leave(unlocked));
    WriterId ended = dead();
    ended.device = device;
    expect_swept(leave(ended));
    WriterId elsewhere = ended;
    ++elsewhere.process_namespace;
    expect_kept(leave(elsewhere));
    expect_kept(leave_aged(elsewhere, std::chrono::hours(24 * 6)));
    expect_swept(leave_aged(elsewhere, std::chrono::hours(24 * 8)));
  }
}

TEST_F(Temporary, OfAnotherMachineIsSweptAfterAWeek) {
  WriterId foreign = dead();
  foreign.boot ^= 1;
  expect_kept(leave(foreign));
  expect_kept(leave_aged(foreign, std::chrono::hours(24 * 6)));
  expect_swept(leave_aged(foreign, std::chrono::hours(24 * 8)));
  // Nor is anything known of a writer who did not know its machine.
  foreign.boot = 0;
  expect_kept(leave(foreign));
}

TEST_F(Temporary, OfAnotherMachineIsKeptWhileALockOnItIsSeen) {
  WriterId foreign = here();
  foreign.boot ^= 1;
  const TemporaryFile living(folder_ / "a.exr");
  const fs::path aged = name(foreign);
  fs::rename(fs::directory_iterator(folder_)->path(), aged);
  fs::last_write_time(aged, fs::file_time_type::clock::now() - kOld);
  EXPECT_EQ(sweep_temporaries(folder_), 0);
}

TEST_F(Temporary, IsOnlyWhatIsExactlyOfOurForm) {
  const WriterId writer = dead();
  const std::string id = text_of(writer);
  std::string upper = id;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  for (const std::string& other :
       {std::string(".my.important.vm.999998.backup.tmp"), std::string("a.tmp"), std::string(".b"),
        "a.exr." + id + "-0.tmp", "." + id + "-0.tmp", ".a.exr." + id + "-0.tmp~",
        ".a.exr." + id + "-0.TMP", ".a.exr." + id + ".tmp", ".a.exr." + id + "-.tmp",
        ".a.exr." + id + "-00.tmp", ".a.exr." + id + "-0-0.tmp", ".a.exr." + id + "-x.tmp",
        ".a.exr." + id + "--1.tmp", ".a.exr." + id + " -0.tmp", ".a.exr." + upper + "-0.tmp",
        ".a.exr.0" + id + "-0.tmp", ".a.exr." + id.substr(0, id.rfind('-')) + "-0.tmp"}) {
    put(folder_ / other, "x");
    fs::last_write_time(folder_ / other, fs::file_time_type::clock::now() - kOld);
    EXPECT_EQ(sweep_temporaries(folder_), 0) << other;
    EXPECT_TRUE(fs::remove(folder_ / other)) << other;
  }
}

TEST_F(Temporary, OfAFolderThatIsMissingAreNone) {
  EXPECT_EQ(sweep_temporaries(folder_ / "none"), 0);
}

TEST_F(Temporary, IsNothingButAFile) {
  const fs::path path = name(dead());
  put(folder_ / "target", "x");
  fs::create_symlink("target", path);
  expect_kept(path);
  fs::create_directory(path);
  expect_kept(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_kept(path);
}

TEST_F(Temporary, ReplacesNoFolderNoPipeAndNoDevice) {
  fs::create_directories(folder_ / "folder" / "inside");
  EXPECT_THROW(TemporaryFile(folder_ / "folder"), InputError);
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(TemporaryFile(folder_ / "pipe"), InputError);
  EXPECT_THROW(TemporaryFile("/dev/null"), InputError);
  EXPECT_EQ(file_count(), 2);
}

TEST_F(Temporary, HasANameThatIsWholeCharacters) {
  std::string stem(39, 'x');
  stem += "éé.exr";  // the 40th byte is half a letter
  const TemporaryFile file(folder_ / stem);
  EXPECT_TRUE(fs::directory_iterator(folder_)->path().filename().string().starts_with(
      "." + std::string(39, 'x') + ".domefall-"));
}

constexpr int kCannotTry = 77;

int exit_code(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// Starts `body` as process 1 of a PID namespace with a /proc of its own, as containers have it.
pid_t start_container(const std::function<int()>& body) {
  const pid_t outer = fork();
  if (outer != 0) return outer;
  if (unshare(CLONE_NEWPID | CLONE_NEWNS) != 0 ||
      mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
    _exit(kCannotTry);
  const pid_t first = fork();
  if (first == 0) {
    if (mount("proc", "/proc", "proc", 0, nullptr) != 0) _exit(kCannotTry);
    _exit(body());
  }
  _exit(exit_code(first));
}

TEST_F(Temporary, OfALivingContainerSurvivesItsNamesakesAndOfADeadOneDoesNot) {
  std::array<int, 2> told{}, asked{};
  ASSERT_EQ(pipe2(told.data(), O_CLOEXEC) | pipe2(asked.data(), O_CLOEXEC), 0);
  char byte = 0;
  const pid_t writer = start_container([&] {
    const TemporaryFile file(folder_ / "a.exr");
    (void)!write(told[1], &byte, 1);
    (void)!read(asked[0], &byte, 1);
    _exit(0);  // as a kill: nothing is cleaned up
    return 0;
  });
  close(told[1]);
  const bool begun = read(told[0], &byte, 1) == 1;
  const auto sweep = [this] { return sweep_temporaries(folder_); };
  const int by_namesake = exit_code(start_container(sweep)), by_host = sweep();
  (void)!write(asked[1], &byte, 1);
  if (exit_code(writer) == kCannotTry) GTEST_SKIP() << "no namespaces here";
  ASSERT_TRUE(begun);
  EXPECT_EQ(by_namesake, 0);
  EXPECT_EQ(by_host, 0);
  EXPECT_EQ(file_count(), 1);
  EXPECT_EQ(exit_code(start_container(sweep)), 1) << "process 1 is taken for the one before";
  EXPECT_EQ(file_count(), 0);
}

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
  in_a_child([] {
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
  dead.process = in_a_child([] {});
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
  dead.process = in_a_child([] {});
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
  in_a_child([] {
    const ScratchFolder folder;
    put(folder / "a", "x");
    remove_unfinished();
    _exit(0);
  });
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace domefall
