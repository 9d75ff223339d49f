#include "pipeline/report/frame_errors.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

const std::vector<FrameErrorRow>& quick() {
  static const std::vector<FrameErrorRow> rows = measure_frames(true);
  return rows;
}

TEST(FrameErrors, FallWithMoreSamples) {
  ASSERT_EQ(quick().size(), 4u);
  for (std::size_t k = 1; k < quick().size(); ++k) {
    EXPECT_LT(quick()[k].rms, quick()[k - 1].rms) << quick()[k].setting;
    EXPECT_LE(quick()[k].worst, quick()[k - 1].worst) << quick()[k].setting;
  }
}

// Of 8 bits, in the mean; a frame of 256 pixels is the smallest that anyone would look at.
TEST(FrameErrors, OfTheDefaultAreBelowTwoStepsOfADisplay) {
  for (const FrameErrorRow& row : quick()) {
    EXPECT_GT(row.rms, 0) << row.setting;
    EXPECT_GE(row.worst, row.rms) << row.setting;
    EXPECT_LE(row.worst, 1) << row.setting;
    if (row.setting.find("default") == std::string::npos) continue;
    EXPECT_LT(row.rms, 2.0 / 255);
  }
}

TEST(FrameErrors, AreGivenWithTheirSceneSizeAndCost) {
  for (const FrameErrorRow& row : quick()) {
    EXPECT_EQ(row.scene, quick().front().scene);
    EXPECT_EQ(row.size, 256);
    EXPECT_GT(row.seconds, 0);
    // One copy, the same for all rows.
    EXPECT_NEAR(row.seconds / row.copies, quick().front().seconds / quick().front().copies, 1e-12);
  }
}

}  // namespace
}  // namespace domefall
