// Files that appear whole or not at all, also where a write cannot end: on a full disk, without
// permission, killed.

#include "pipeline/base/new_file.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "pipeline/base/errors.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr int kNotTried = 77;

// Runs `body` in a process of its own and returns its exit code.
int exit_code_of_child(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// Nobody's pixels: noise that no compression makes to fit.
template <class Frame>
Frame noise_frame(int side) {
  Frame frame(side, side);
  unsigned state = 1;
  for (auto& value : frame.pixels) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<unsigned short>(state >> 18);
  }
  return frame;
}

class InterruptedWrite : public TestFolder {
 protected:
  fs::path file(const std::string& extension) const { return folder_ / ("frame" + extension); }

  // `write` fails as it must on a full disk and leaves the older file and no other.
  void fails_on_a_full_disk(const fs::path& path,
                            const std::function<void(const fs::path&)>& write) const {
    write_atomically(path, "old");
    EXPECT_EQ(message_of<TemporaryError>([&] { write(path); }),
              path.string() + ": No space left on device");
    EXPECT_EQ(contents(path), "old");
    EXPECT_TRUE(fs::remove(path));
    EXPECT_EQ(file_count(), 0) << path;
  }
};

TEST_F(InterruptedWrite, AMissingFolderMayBeThereLaterAndIsNamed) {
  EXPECT_EQ(message_of<TemporaryError>([&] { write_atomically(folder_ / "none" / "a.bin", "x"); }),
            (folder_ / "none/a.bin").string() + ": No such file or directory");
}

// A limit on the size of files stands in for a full disk.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{100'000, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// The encoders are in the middle of the file when the disk is full.
TEST_F(InterruptedWrite, BeyondALimitOnTheSizeOfFilesIsForLaterAndLeavesTheOldFile) {
  write_atomically(file(".txt"), "old");
  {
    const FullDisk limit;
    EXPECT_THROW(write_atomically(file(".txt"), std::string(1'000'000, 'x')), TemporaryError);
    EXPECT_THROW(write_frame(file(".exr"), noise_frame<HalfFrame>(400), {}), TemporaryError);
    for (const char* kind : {".png", ".tif", ".jpg"})
      EXPECT_THROW(
          write_graded(file(kind), noise_frame<GradedFrame>(600), {}, format_by_name(file(kind))),
          TemporaryError)
          << kind;
  }
  EXPECT_EQ(contents(file(".txt")), "old");
  EXPECT_EQ(file_count(), 1);
}

// A file system of 256 KiB, in a mount name space of a thread's own: a forked child would lack
// OpenImageIO's threads and wait for them for ever.  OpenEXR and OpenImageIO would each tell of a
// full disk in a way of their own, or not at all.
TEST_F(InterruptedWrite, OnAFullDiskLeavesTheOldFileAndMayBeTriedAgain) {
  bool mounted = false;
  std::thread([&] {
    mounted = unshare(CLONE_NEWNS) == 0 &&
              mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
              mount("none", folder_.c_str(), "tmpfs", 0, "size=256k,mode=777") == 0;
    if (!mounted) return;
    fails_on_a_full_disk(file(".txt"), [](const fs::path& path) {
      write_atomically(path, std::string(1 << 20, 'n'));
    });
    fails_on_a_full_disk(file(".exr"), [](const fs::path& path) {
      write_frame(path, noise_frame<HalfFrame>(400), {});
    });
    for (const char* kind : {".png", ".tif", ".jpg"})
      fails_on_a_full_disk(file(kind), [](const fs::path& path) {
        write_graded(path, noise_frame<GradedFrame>(600), {}, format_by_name(path));
      });
  }).join();
  if (!mounted) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(file_count(), 0) << "a file went to the folder below the mount";
}

TEST_F(InterruptedWrite, WithoutPermissionMayBeTriedElsewhere) {
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  const int result = exit_code_of_child([this] {
    if (geteuid() == 0 && setuid(65534) != 0) return kNotTried;  // root may write anywhere
    try {
      write_atomically(file(".exr"), "contents");
      return 1;
    } catch (const TemporaryError&) {
      return 0;
    }
  });
  fs::permissions(folder_, fs::perms::owner_all);
  if (result == kNotTried) GTEST_SKIP() << "root, and cannot become another user";
  EXPECT_EQ(result, 0);
}

// A writer killed at any moment leaves one of the files that it wrote, whole, and at most a
// temporary, which the next run sweeps.
TEST_F(InterruptedWrite, KilledLeavesAWholeFileAndATemporaryThatIsSwept) {
  const std::string even(3 << 20, 'e'), odd(2 << 20, 'o');
  write_atomically(file(".exr"), even);
  int left = 0;
  for (int run = 0; run < 12; ++run) {
    const pid_t writer = fork();
    if (writer == 0)
      for (int k = 0;; ++k) write_atomically(file(".exr"), k % 2 ? odd : even);
    std::this_thread::sleep_for(std::chrono::milliseconds(11 + 7 * run));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    const std::string found = contents(file(".exr"));
    EXPECT_TRUE(found == even || found == odd) << "run " << run << ": " << found.size() << " bytes";
    const int temporaries = file_count() - 1;
    EXPECT_EQ(sweep_temporaries(folder_), temporaries);
    EXPECT_EQ(file_count(), 1);
    left += temporaries;
  }
  EXPECT_GT(left, 0) << "no kill came in the middle of a write: nothing was tested";
}

TEST_F(InterruptedWrite, SweepingNeverLooksIntoFoldersBelow) {
  fs::create_directory(folder_ / "below");
  exit_code_of_child([this] {
    const TemporaryFile file(folder_ / "below" / "a.exr");
    _exit(0);  // as a kill: nothing is cleaned up
    return 0;
  });
  EXPECT_EQ(sweep_temporaries(folder_), 0);
  EXPECT_EQ(sweep_temporaries(folder_ / "below"), 1);
}

TEST_F(InterruptedWrite, ANameOfTheLongestLengthHasRoomForItsTemporary) {
  const fs::path longest = folder_ / std::string(255, 'x');
  write_atomically(longest, "contents");
  EXPECT_EQ(contents(longest), "contents");
}

using NewFileTest = TestFolder;

// Pieces smaller and larger than what is written at once, and corrections in what is on the disk
// already.
TEST_F(NewFileTest, HoldsWhatWasWrittenWhereverItWasSought) {
  std::string expected;
  {
    NewFile file(folder_ / "a.bin");
    for (int k = 0; k < 40; ++k) {
      const std::string piece(static_cast<std::size_t>(1 + k * k * 641),
                              static_cast<char>('a' + k));
      file.write(piece);
      expected += piece;
      EXPECT_EQ(file.position(), expected.size());
    }
    for (const std::size_t at : {std::size_t{3}, expected.size() / 2, expected.size() - 5}) {
      file.seek(at);
      file.write("here");
      expected.replace(at, 4, "here");
      EXPECT_EQ(file.position(), at + 4);
      EXPECT_EQ(file.size(), expected.size());
    }
    file.seek(file.size());
    file.write("end");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.bin"));
    file.commit();
  }
  EXPECT_EQ(contents(folder_ / "a.bin"), expected + "end");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(NewFileTest, ThatIsNotCommittedLeavesTheOldOne) {
  put(folder_ / "a.bin", "old");
  {
    NewFile file(folder_ / "a.bin");
    file.write(std::string(1'000'000, 'x'));
  }
  EXPECT_EQ(contents(folder_ / "a.bin"), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST(FileError, IsTemporaryWhereTryingAgainMayHelp) {
  for (const int error : {ENOSPC, EDQUOT, EIO, ESTALE, ETIMEDOUT, EMFILE, ENOENT, ENOTDIR, EACCES,
                          EPERM, EROFS, EFBIG, ENXIO, EBUSY, ENOMEM, ENOLCK})
    EXPECT_THROW(throw_file_error("/f", error), TemporaryError) << error;
  for (const int error : {ENAMETOOLONG, EISDIR, ELOOP})
    EXPECT_THROW(throw_file_error("/f", error), InputError) << error;
}

}  // namespace
}  // namespace domefall
