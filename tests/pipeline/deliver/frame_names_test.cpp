#include "pipeline/deliver/frame_names.h"

#include <gtest/gtest.h>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

TEST(DeliveredFrameNames, CountFromOneWithFiveDigits) {
  const DeliveredNames names(default_name_pattern("my_show", 240), 240, "png");
  EXPECT_EQ(names.path(0), "frames/my_show_00001.png");
  EXPECT_EQ(names.path(239), "frames/my_show_00240.png");
}

TEST(DeliveredFrameNames, PutAtMostTenThousandInAFolder) {
  const DeliveredNames all_in_one(default_name_pattern("a", 10000), 10000, "png");
  EXPECT_EQ(all_in_one.path(9999), "frames/a_10000.png");
  const DeliveredNames two(default_name_pattern("a", 10001), 10001, "tif");
  EXPECT_EQ(two.path(0), "frames/a_00001_10000/a_00001.tif");
  EXPECT_EQ(two.path(9999), "frames/a_00001_10000/a_10000.tif");
  EXPECT_EQ(two.path(10000), "frames/a_10001_20000/a_10001.tif");
}

TEST(DeliveredFrameNames, HaveAsManyDigitsAsTheLastOneNeeds) {
  const DeliveredNames names(default_name_pattern("a", 100000), 100000, "png");
  EXPECT_EQ(names.path(0).filename(), "a_000001.png");
  EXPECT_THROW(DeliveredNames(parse_name_pattern("a_##"), 100, "png"), InputError);
  EXPECT_NO_THROW(DeliveredNames(parse_name_pattern("a_##"), 99, "png"));
}

TEST(DeliveredFrameNames, FollowAPattern) {
  const DeliveredNames names(parse_name_pattern("Show-4K60_######_v2"), 5, "png");
  EXPECT_EQ(names.path(4), "frames/Show-4K60_000005_v2.png");
  EXPECT_EQ(pattern_text(names.pattern()), "Show-4K60_######_v2");
}

TEST(DeliveredFrameNames, RefuseWhatScriptsTakeForMore) {
  for (const char* text :
       {"", "show", "a_#_#", "a/b_#####", "../a_#####", ".a_#####", "-a_#####", "a b_#####",
        "a$_#####", "a_###########", "\xc3\xa4_#####", "a\n#", "a_#####.png", "#."})
    EXPECT_THROW(parse_name_pattern(text), InputError) << text;
}

TEST(DeliveredFrameNames, ReplaceOddCharactersOfAShowsName) {
  EXPECT_EQ(pattern_text(default_name_pattern("my show: 2", 1)), "my_show__2_#####");
  EXPECT_EQ(pattern_text(default_name_pattern(".a", 1)), "_a_#####");
  EXPECT_NO_THROW(parse_name_pattern(pattern_text(default_name_pattern(std::string(250, 'x'), 1))));
}

}  // namespace
}  // namespace domefall
