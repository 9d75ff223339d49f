#include "pipeline/image/frame_head.h"

#include <gtest/gtest.h>

#include "pipeline/image/graded_file.h"
#include "pipeline/image/scratch_folder.h"

namespace domefall {
namespace {

TEST(FrameHead, SaysSizeAndBitsOfEveryKind) {
  const ScratchFolder folder;
  GradedInfo info;
  info.key = "0123";
  info.title = "A show";
  for (const auto& [kind, name, bits] : {std::tuple{GradedKind::kPng16, "a.png", 16},
                                         {GradedKind::kPng8, "b.png", 8},
                                         {GradedKind::kTiff16, "a.tif", 16},
                                         {GradedKind::kTiff8, "b.tif", 8},
                                         {GradedKind::kJpeg, "a.jpg", 8}}) {
    write_graded(folder / name, GradedFrame(24, 16), info, {kind});
    const auto head = read_frame_head(*FileBytes::open(folder / name));
    ASSERT_TRUE(head) << name;
    EXPECT_EQ(head->bits, bits) << name;
    EXPECT_EQ(head->width, 24) << name;
    EXPECT_EQ(head->height, 16) << name;
    EXPECT_EQ(head->key, "0123") << name;
    EXPECT_EQ(head->title, "A show") << name;
  }
}

}  // namespace
}  // namespace domefall
