// Keys of frames know when the assets that they were made of have been touched.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "pipeline/render/frame_key.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

class FrameAssets : public testing::Test {
 protected:
  FrameAssets()
      : folder_(fs::temp_directory_path() /
                (std::string("domefall_assets_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
                 std::to_string(getpid()))) {
    fs::create_directories(folder_);
    write("day");
    show_.sky[SkyRegion::kI].background = PanoramaSky{panorama()};
    wait();
  }
  ~FrameAssets() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path panorama() const { return folder_ / "sky.png"; }
  // Only its bytes matter: keys do not look into a panorama.
  void write(const char* text) const { std::ofstream(panorama()) << text; }
  // Longer than the grain of a file system's clock.
  static void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(30)); }

  fs::path folder_;
  Show show_;
};

TEST_F(FrameAssets, AreUntouchedWhileOnlyRead) {
  const FrameKeys keys(show_);
  std::string text;
  std::ifstream(panorama()) >> text;
  EXPECT_EQ(keys.touched_asset(), std::nullopt);
}

// As a swap that is undone before anybody looks at the content again.
TEST_F(FrameAssets, AreTouchedByASwapThatWasUndone) {
  const FrameKeys keys(show_);
  fs::rename(panorama(), folder_ / "kept.png");
  write("night");
  fs::remove(panorama());
  fs::rename(folder_ / "kept.png", panorama());
  EXPECT_EQ(keys.touched_asset(), panorama());
  EXPECT_TRUE(keys.same_assets(FrameKeys(show_)));
}

// Of the same length and with the old time of writing.
TEST_F(FrameAssets, AreTouchedByAWriteThatHidesItself) {
  const FrameKeys keys(show_);
  struct stat before {};
  ASSERT_EQ(stat(panorama().c_str(), &before), 0);
  write("dim");
  const timespec times[] = {before.st_atim, before.st_mtim};
  ASSERT_EQ(utimensat(AT_FDCWD, panorama().c_str(), times, 0), 0);
  EXPECT_EQ(keys.touched_asset(), panorama());
  EXPECT_FALSE(keys.same_assets(FrameKeys(show_)));
}

TEST_F(FrameAssets, AreTouchedByTheirRemoval) {
  const FrameKeys keys(show_);
  fs::remove(panorama());
  EXPECT_EQ(keys.touched_asset(), panorama());
  EXPECT_ANY_THROW(FrameKeys{show_});
}

}  // namespace
}  // namespace domefall
