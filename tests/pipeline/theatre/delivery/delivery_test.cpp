// What a delivery has beside its frames: names, checksums and pictures.

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "pipeline/base/errors.h"
#include "pipeline/base/temporary_file.h"
#include "pipeline/theatre/delivery/checksum_list.h"
#include "pipeline/theatre/delivery/contact_sheet.h"
#include "pipeline/theatre/delivery/frame_names.h"
#include "pipeline/theatre/delivery/test_pictures.h"

namespace domefall {
namespace {

TEST(ChecksumList, HoldsTheSumsOfTheStandard) {
  const ScratchFolder folder;
  std::ofstream(folder / "abc") << "abc";
  std::ofstream(folder / "empty");
  // FIPS 180-2, appendix B.1, and the sum of no bytes.
  EXPECT_EQ(sha256_of_file(folder / "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(folder / "empty"),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(ChecksumList, IsReadBack) {
  const std::vector<ListedFile> files{{std::string(64, 'a'), "frames/a_00001.png"},
                                      {std::string(64, '0'), "audio/my sound.wav"}};
  EXPECT_EQ(parse_checksum_list(checksum_list(files)), files);
  EXPECT_TRUE(parse_checksum_list("").empty());
}

TEST(ChecksumList, IsRefusedWhereItIsBrokenOffOrLeadsOut) {
  const std::string sum(64, 'a');
  for (const std::string& text :
       {sum + "  a", sum + " a\n", sum + "  \n", sum.substr(1) + "  a\n", sum + "b  a\n",
        sum + "  ../a\n", sum + "  /etc/passwd\n", sum + "  b/../../a\n", std::string("\n"),
        std::string(64, 'G') + "  a\n"})
    EXPECT_THROW(parse_checksum_list(text), InputError) << text;
}

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

const ShowLines kLines{"A show", "128 x 128"};

double light_of(const GradedFrame& picture, int x0, int y0, int x1, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += picture.row(y)[3 * x + 1];
  return sum / 65535;
}

TEST(AlignmentFrame, HasItsRimAtTheEdgeAndBlackCorners) {
  const GradedFrame frame = alignment_frame(Domemaster{256}, kLines);
  for (const auto& [x, y] : {std::pair{128, 1}, {128, 254}, {1, 128}, {254, 128}})
    EXPECT_GT(frame.row(y)[3 * x], 40000) << x << ", " << y;
  EXPECT_EQ(light_of(frame, 0, 0, 36, 36), 0);
  EXPECT_EQ(light_of(frame, 220, 220, 256, 256), 0);
}

// Greys from black to white: their codes are multiples of 17 in 8 bits, and nothing blends them.
TEST(AlignmentFrame, HasSixteenExactGreys) {
  const GradedFrame frame = alignment_frame(Domemaster{1024}, kLines);
  const int y = 512 + 1024 * 55 / 180 + 1024 * 20 / 1000 + 8;
  int last = -1, steps = 0;
  for (int x = 512 - 144; x < 512 + 144; ++x) {
    const unsigned short* rgb = frame.row(y) + 3 * x;
    EXPECT_EQ(rgb[0] % (17 * 257), 0) << x;
    EXPECT_TRUE(rgb[0] == rgb[1] && rgb[1] == rgb[2]) << x;
    if (rgb[0] > last) ++steps, last = rgb[0];
  }
  EXPECT_EQ(last, 65535);
  EXPECT_GE(steps, 15);
}

TEST(Leader, LastsEightSecondsAndStandsAtTheFront) {
  EXPECT_EQ(leader_frames(30), 240);
  EXPECT_EQ(leader_frames(29.97), 240);
  EXPECT_EQ(leader_frames(1), 8);
  for (const int k : {0, 100, 239}) {
    const GradedFrame frame = leader_frame(Domemaster{128}, kLines, 30, k);
    EXPECT_GT(light_of(frame, 20, 70, 108, 128), 10) << k;
    EXPECT_EQ(light_of(frame, 0, 0, 128, 64), 0) << k << ": nothing is at the back";
  }
}

TEST(Leader, CountsSecondsDownToOne) {
  const auto frame = [](int k) { return leader_frame(Domemaster{128}, kLines, 4, k).pixels; };
  // The hand stands at the top at the beginning of each second, beside another number.
  for (int k = 12; k + 4 < 32; k += 4) EXPECT_NE(frame(k), frame(k + 4)) << k;
  for (int k = 0; k + 1 < 32; ++k) EXPECT_NE(frame(k), frame(k + 1)) << k;
}

TEST(TestPictures, AreDrawnOnFlatAndOnTinyPicturesToo) {
  const Stereographic flat{200, 100, std::numbers::pi / 2};
  const GradedFrame grid = alignment_frame(flat, kLines);
  EXPECT_EQ(grid.width, 200);
  EXPECT_EQ(grid.height, 100);
  EXPECT_GT(grid.row(0)[3 * 50], 40000) << "the border";
  EXPECT_GT(light_of(leader_frame(flat, kLines, 30, 200), 0, 0, 200, 100), 10);
  EXPECT_NO_THROW(alignment_frame(Domemaster{16}, kLines));
  EXPECT_NO_THROW(leader_frame(Domemaster{16}, {"", ""}, 30, 0));
  EXPECT_NO_THROW(leader_frame(Domemaster{16}, {"named by a file: \xff"}, 30, 0));
}

TEST(ContactSheet, SpreadsItsFramesOverTheShow) {
  EXPECT_EQ(frames_of_sheet(1), std::vector<int>{0});
  EXPECT_EQ(frames_of_sheet(3), (std::vector<int>{0, 1, 2}));
  const auto many = frames_of_sheet(10'000'000);
  EXPECT_EQ(many.size(), 36u);
  EXPECT_EQ(many.front(), 138'888);
  EXPECT_EQ(many.back(), 9'861'111);
}

TEST(ContactSheet, KeepsTheMeanOfWhatItReduces) {
  GradedFrame picture(7, 5);
  for (std::size_t k = 0; k < picture.pixels.size(); ++k)
    picture.pixels[k] = static_cast<unsigned short>(1000 * (k % 3));
  const GradedFrame small = reduced_picture(picture, 3, 100);
  EXPECT_EQ(small.width, 3);
  EXPECT_EQ(small.height, 2);
  for (std::size_t k = 0; k < small.pixels.size(); ++k)
    EXPECT_EQ(small.pixels[k], 1000 * (k % 3)) << k;
  EXPECT_EQ(reduced_picture(picture, 100, 100).pixels, picture.pixels);
}

TEST(ContactSheet, ShowsPixelsAsAScreenDoes) {
  GradedFrame picture(40, 60);
  for (std::size_t k = 0; k < picture.pixels.size(); ++k)
    picture.pixels[k] = static_cast<unsigned short>(1000 * (k % 3));
  for (const auto& [pixel, width, height] :
       {std::tuple{ScreenSides{1, 0.5}, 40, 30}, {ScreenSides{0.75, 1}, 30, 60}}) {
    const GradedFrame shown = reduced_picture(picture, 100, 100, pixel);
    EXPECT_EQ(shown.width, width);
    EXPECT_EQ(shown.height, height);
    EXPECT_EQ(shown.row(7)[3 * 5 + 2], 2000);
  }
  const GradedFrame small = reduced_picture(picture, 20, 20, {1, 0.5});
  EXPECT_EQ(small.width, 20);
  EXPECT_EQ(small.height, 15);
}

TEST(ContactSheet, ShowsEveryPicture) {
  std::vector<SheetPicture> pictures;
  for (int k = 0; k < 7; ++k) {
    GradedFrame picture(256, 256);
    for (auto& code : picture.pixels) code = static_cast<unsigned short>(257 * (20 + k));
    pictures.push_back({std::move(picture), std::to_string(k)});
  }
  const GradedFrame sheet = contact_sheet("A show", pictures);
  for (int k = 0; k < 7; ++k) {
    long count = 0;
    for (std::size_t at = 0; at < sheet.pixels.size(); at += 3)
      count += sheet.pixels[at] == 257 * (20 + k);
    EXPECT_GE(count, 256 * 256) << k;
  }
}

}  // namespace
}  // namespace domefall
