#include "pipeline/image/new_file.h"

#include <sys/resource.h>

#include <csignal>

#include "pipeline/image/errors.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

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
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// The encoders are in the middle of the file when the disk is full.
TEST_F(NewFileTest, OnAFullDiskFramesAreForLaterAndLeaveNothing) {
  HalfFrame frame(400, 300);
  GradedFrame graded(400, 300);
  unsigned noise = 1;  // or the encoders make them small
  for (std::size_t k = 0; k < graded.pixels.size(); ++k) {
    noise = noise * 1664525u + 1013904223u;
    graded.pixels[k] = static_cast<unsigned short>(noise >> 16);
    frame.pixels[k] = static_cast<float>(noise >> 16);
  }
  {
    const FullDisk limit;
    EXPECT_THROW(write_frame(folder_ / "a.exr", frame, {}), TemporaryError);
    EXPECT_THROW(write_graded(folder_ / "a.png", graded, {}, {GradedKind::kPng16}), TemporaryError);
    EXPECT_THROW(write_graded(folder_ / "a.tif", graded, {}, {GradedKind::kTiff16}),
                 TemporaryError);
    EXPECT_THROW(write_graded(folder_ / "a.jpg", graded, {}, {GradedKind::kJpeg}), TemporaryError);
  }
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace domefall
