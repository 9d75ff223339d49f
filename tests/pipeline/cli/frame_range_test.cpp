#include "pipeline/cli/frame_range.h"

#include <gmock/gmock.h>

#include "pipeline/cli/frame_size.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

using testing::ElementsAre;

TEST(FrameRange, NamesFramesOneByOneByRangeAndByStep) {
  EXPECT_THAT(parse_frames("", 3), ElementsAre(0, 1, 2));
  EXPECT_THAT(parse_frames("7", 10), ElementsAre(7));
  EXPECT_THAT(parse_frames("2-5", 10), ElementsAre(2, 3, 4, 5));
  EXPECT_THAT(parse_frames("0-9x4", 10), ElementsAre(0, 4, 8));
  EXPECT_THAT(parse_frames("8,1-3,2", 10), ElementsAre(1, 2, 3, 8)) << "once each, in order";
  EXPECT_THAT(parse_frames("5-9x2147483647", 10), ElementsAre(5));
}

TEST(FrameRange, RefusesWhatTheShowHasNotAndWhatIsNoRange) {
  for (const char* text :
       {"10", "0-10", "5-2", "x", "-1", "1-", "1,", "1 2", "0-9x0", "99999999999", "1.5", "0-9y2"})
    EXPECT_THROW(parse_frames(text, 10), InputError) << text;
}

TEST(Size, IsByNameOrByPixels) {
  EXPECT_EQ(columns(resized(Domemaster{16}, "4k")), 4096);
  EXPECT_EQ(columns(resized(Domemaster{16}, "1000")), 1000);
  EXPECT_EQ(columns(resized(Domemaster{16}, "")), 16);
  const Projection flat = resized(Stereographic{16, 16, 1.5}, "1920x1080");
  EXPECT_EQ(columns(flat), 1920);
  EXPECT_EQ(rows(flat), 1080);
  const Projection part = Fisheye{4096, 3072, 3.5, 1};
  EXPECT_EQ(rows(resized(part, "1k")), 768);
  EXPECT_EQ(columns(resized(part, "640x100")), 640);
  EXPECT_EQ(rows(resized(part, "640x100")), 100);
  EXPECT_EQ(rows(resized(Equirectangular{16}, "8k")), 4096);
  EXPECT_EQ(columns(resized(Cubemap{16}, "1k")), 3072);
  EXPECT_EQ(field_of_view(resized(Rectilinear{16, 16, 1.5}, "640x480")), 1.5);
  for (const char* text : {"100x101", "15x15", "15", "5k"})
    EXPECT_THROW(resized(part, text), InputError) << text;
  for (const char* text : {"101", "15", "1920x960"})
    EXPECT_THROW(resized(Equirectangular{16}, text), InputError) << text;
  for (const char* text : {"8k", "5462", "15", "300x200"})
    EXPECT_THROW(resized(Cubemap{16}, text), InputError) << text;
  for (const char* text : {"0k", "17k", "15", "16385", "4K", "k", "1920x1080", "-5"})
    EXPECT_THROW(resized(Domemaster{16}, text), InputError) << text;
  for (const char* text : {"4k", "1920", "1920x", "x1080", "1920x8", "1920x1080x3"})
    EXPECT_THROW(resized(Stereographic{16, 16, 1.5}, text), InputError) << text;
}

}  // namespace
}  // namespace domefall
