#include "pipeline/deliver/subtitle_file.h"

#include <gmock/gmock.h>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

TEST(Subtitles, EndWithTheLastOneToGo) {
  const SubtitleFile found = parse_subtitles(
      "\xef\xbb\xbf"
      "1\r\n00:00:01,000 --> 00:00:09,250\r\nHello\r\n\r\n"
      "2\n00:00:02,000 --> 00:00:03,500 X1:10 X2:20\nthere\n\n"
      "3\n1:02:03.004 --> 1:02:04.005");
  EXPECT_EQ(found.count, 3);
  EXPECT_DOUBLE_EQ(found.end_s, 3600 + 2 * 60 + 4.005);
}

TEST(Subtitles, AreRefusedWithTheLineOfAWrongTime) {
  const auto message = [](const char* text) {
    try {
      parse_subtitles(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(message("1\n00:00:01,000 --> 00:00:xx,000\n"), testing::HasSubstr("line 2"));
  EXPECT_THAT(message("1\n00:00:04,000 --> 00:00:01,000\n"),
              testing::HasSubstr("before it begins"));
  EXPECT_THAT(message("WEBVTT\n"), testing::HasSubstr("no subtitle"));
  EXPECT_THAT(message(""), testing::HasSubstr("no subtitle"));
  for (const char* time : {"00:00:01", "00:61:01,000", "00:00:61,000", "00:00:1,000", ":00:01,000",
                           "00:00:01,0000", "-0:00:01,000", "99999:00:01,000", ""})
    EXPECT_THROW(parse_subtitles(std::string("00:00:00,000 --> ") + time), InputError) << time;
}

}  // namespace
}  // namespace domefall
