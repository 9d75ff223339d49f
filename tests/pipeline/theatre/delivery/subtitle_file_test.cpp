#include "pipeline/theatre/delivery/subtitle_file.h"

#include <gmock/gmock.h>

#include "tests/pipeline/image/test_folder.h"

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
  const auto message = [](const char* text) { return message_of([&] { parse_subtitles(text); }); };
  EXPECT_THAT(message("1\n00:00:01,000 --> 00:00:xx,000\n"), testing::HasSubstr("line 2"));
  EXPECT_THAT(message("1\n00:00:04,000 --> 00:00:01,000\n"),
              testing::HasSubstr("before it begins"));
  EXPECT_THAT(message("WEBVTT\n"), testing::HasSubstr("no subtitle"));
  EXPECT_THAT(message(""), testing::HasSubstr("no subtitle"));
  for (const char* time : {"00:00:01,", "00:61:01,000", "00:00:61,000", "00:00:1,000", ":00:01,000",
                           "00:00:01,0000", "-0:00:01,000", "99999:00:01,000", ""})
    EXPECT_THROW(parse_subtitles(std::string("00:00:00,000 --> ") + time), InputError) << time;
}

TEST(Subtitles, MayHaveFewDigitsOfAFractionOrNone) {
  for (const auto& [text, end] : std::initializer_list<std::pair<const char*, double>>{
           {"1\n00:00:00,10 --> 00:00:00,50\nx\n", 0.5},
           {"1\n00:00:00.1 --> 00:00:00.5\nx\n", 0.5},
           {"1\n00:00:00 --> 00:00:01\nx\n", 1},
           {"1\n0:00:00,005-->0:00:00,007\nx\n", 0.007},
           {"WEBVTT\n\nintro\n00:01.000 --> 01:02.500 align:start\nx\n", 62.5}})
    EXPECT_DOUBLE_EQ(parse_subtitles(text).end_s, end) << text;
}

TEST(Subtitles, MaySpeakOfArrows) {
  for (const char* text :
       {"1\n00:00:00,100 --> 00:00:00,300\nleft --> right\n\n2\n00:00:00,400 --> 00:00:00,800\nx\n",
        "1\n00:00:00,100 --> 00:00:00,300\nHello\n1:30 --> 2\n\n2\n00:00:00,400 --> 00:00:00,800\n",
        "1\n00:00:00,100 --> 00:00:00,300\nHello\n\nleft --> right\n\n2\n00:00:00,4 --> "
        "00:00:00,8\n",
        "00:00:00,100 --> 00:00:00,300\n--> 7\n\n00:00:00,400 --> 00:00:00,800\n-->\n"}) {
    EXPECT_EQ(parse_subtitles(text).count, 2) << text;
    EXPECT_DOUBLE_EQ(parse_subtitles(text).end_s, 0.8) << text;
  }
  // Where times belong, an arrow is one of times.
  for (const char* text : {"1\nleft --> right\n", "1\n--> 00:00:01,000\n", "00:00:01,000 --> x\n",
                           "1\n00:00:01,000 -> 00:00:02,000\n"})
    EXPECT_THAT(message_of([&] { parse_subtitles(text); }), testing::HasSubstr("expected times"))
        << text;
}

TEST(Subtitles, EndTheirLinesInAnyWay) {
  const std::string lines =
      "1/00:00:00,100 --> 00:00:00,300/Hello//2/00:00:00,400 --> 00:00:00,800/W";
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : lines) c == '/' ? text += end : text += c;
    EXPECT_EQ(parse_subtitles(text).count, 2);
    EXPECT_TRUE(parse_subtitles(text).notes.empty());
  }
}

TEST(Subtitles, ThatOverlapOrGoBackAreNoted) {
  const auto cue = [](const char* from, const char* to) {
    return std::string("00:00:") + from + " --> 00:00:" + to + "\nx\n\n";
  };
  EXPECT_THAT(parse_subtitles(cue("01", "03") + cue("02", "04") + cue("04", "05")).notes,
              testing::ElementsAre("line 4: the subtitle begins before the one before it ends"));
  EXPECT_THAT(
      parse_subtitles(cue("05", "06") + cue("01", "02") + cue("03", "04") + cue("02", "03")).notes,
      testing::ElementsAre(
          "line 4: the subtitle begins before the one before it does, and so do 1 more"));
}

TEST(Subtitles, InLatin1AreRefusedWithTheirLine) {
  EXPECT_THAT(message_of([] {
                parse_subtitles(
                    "1\r\n00:00:00 --> 00:00:01\r\nGr\xfc\xdf"
                    "e\r\n");
              }),
              testing::StartsWith(
                  "line 3: the byte 0xFC is not UTF-8; the text may be Windows-1252 or Latin-1"));
}

class SubtitleFiles : public TestFolder {};

TEST_F(SubtitleFiles, InUtf16AreConverted) {
  const std::string text =
      "1\n00:00:00 --> 00:00:01\nGr\xC3\xBC\xC3\x9F"
      "e \xF0\x9F\xAA\x90\n";
  const std::u16string wide = u"1\n00:00:00 --> 00:00:01\nGr\u00fc\u00dfe \U0001fa90\n";
  for (const bool big : {false, true})
    for (const bool marked : {false, true}) {
      std::string bytes;
      for (const char16_t c : (marked ? u"\ufeff" : u"") + wide) {
        bytes += static_cast<char>(big ? c >> 8 : c & 0xff);
        bytes += static_cast<char>(big ? c & 0xff : c >> 8);
      }
      put(folder_ / "u16.srt", bytes);
      const SubtitleFile found = read_subtitle_file(folder_ / "u16.srt");
      EXPECT_EQ(found.count, 1);
      EXPECT_EQ(found.converted, text);
      EXPECT_THAT(found.notes,
                  testing::ElementsAre("the text is UTF-16, and is delivered as UTF-8"));
    }
  put(folder_ / "u8.srt", "\xEF\xBB\xBF" + text);
  EXPECT_EQ(read_subtitle_file(folder_ / "u8.srt").converted, "");
}

TEST_F(SubtitleFiles, OfAnotherKindThanTheirNameAreNoted) {
  const auto notes = [this](const char* name, const std::string& start) {
    put(folder_ / name, start + "00:00:00.000 --> 00:00:01.000\nx\n");
    return read_subtitle_file(folder_ / name).notes;
  };
  EXPECT_THAT(notes("a.srt", "1\n"), testing::IsEmpty());
  EXPECT_THAT(notes("a.VTT", "WEBVTT\n\n"), testing::IsEmpty());
  EXPECT_THAT(notes("a.srt", "WEBVTT\n\n"),
              testing::ElementsAre("the text is WebVTT, whose files are called .vtt"));
  EXPECT_THAT(notes("a.vtt", "1\n"),
              testing::ElementsAre("the text is SubRip, whose files are called .srt"));
}

TEST_F(SubtitleFiles, WithBytesOf0AreRefused) {
  put(folder_ / "a.srt", std::string("1\n00:00:00 --> 00:00:01\nx\0y\n", 28));
  EXPECT_THROW(read_subtitle_file(folder_ / "a.srt"), InputError);
}

}  // namespace
}  // namespace domefall
