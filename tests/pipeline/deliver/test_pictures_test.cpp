#include "pipeline/deliver/test_pictures.h"

#include <gtest/gtest.h>

#include <numbers>

#include "pipeline/deliver/contact_sheet.h"

namespace domefall {
namespace {

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
