#include "pipeline/image/frame_list.h"

#include <gmock/gmock.h>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

using testing::ElementsAre;

TEST(FrameLists, NamesFramesOneByOneByRangeAndByStep) {
  EXPECT_THAT(parse_frames("", 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(parse_frames("7", 10), ElementsAre(7));
  EXPECT_THAT(parse_frames("2-5", 10), ElementsAre(2, 3, 4, 5));
  EXPECT_THAT(parse_frames("0-9x4", 10), ElementsAre(0, 4, 8));
  EXPECT_THAT(parse_frames("8,1-3,2", 10), ElementsAre(1, 2, 3, 8)) << "once each, in order";
  EXPECT_THAT(parse_frames("5-9x2147483647", 10), ElementsAre(5));
}

TEST(FrameLists, RefusesWhatTheShowHasNotAndWhatIsNoRange) {
  for (const char* text :
       {"10", "0-10", "5-2", "x", "-1", "1-", "1,", "1 2", "0-9x0", "99999999999", "1.5", "0-9y2"})
    EXPECT_THROW(parse_frames(text, 10), InputError) << text;
}

TEST(FrameLists, AreWrittenAsRanges) {
  EXPECT_EQ(as_ranges({}), "");
  EXPECT_EQ(as_ranges({7}), "7");
  EXPECT_EQ(as_ranges({0, 1, 2, 9, 11, 12}), "0-2,9,11-12");
  EXPECT_EQ(as_ranges({0, 10, 20, 30, 31, 32, 90}), "0-30x10,31-32,90");
  EXPECT_EQ(as_ranges({1, 3, 5, 7, 8}), "1-7x2,8");
  EXPECT_EQ(as_ranges({1, 3, 5, 9}), "1,3,5,9") << "three are no longer by themselves";
  EXPECT_EQ(as_ranges({0, 5, 6, 7}), "0,5-7");
  EXPECT_THAT(parse_frames(as_ranges({0, 10, 20, 30, 31, 32}), 40),
              ElementsAre(0, 10, 20, 30, 31, 32));
  EXPECT_THAT(parse_frames(as_ranges({0, 1, 2, 9, 11, 12}), 13), ElementsAre(0, 1, 2, 9, 11, 12));
}

}  // namespace
}  // namespace domefall
