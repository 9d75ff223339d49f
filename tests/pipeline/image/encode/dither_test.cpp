#include "pipeline/image/encode/dither.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace domefall {
namespace {

constexpr int kWidth = 512;

std::vector<std::uint8_t> dithered(const std::vector<unsigned short>& codes, int frame = 0,
                                   int y = 0) {
  std::vector<std::uint8_t> out(codes.size());
  const int rows = static_cast<int>(codes.size()) / (3 * kWidth);
  dither_rows(codes.data(), kWidth, rows, y, frame, out.data());
  return out;
}

std::vector<unsigned short> even_rows(unsigned short code, int rows) {
  return std::vector<unsigned short>(std::size_t{3} * kWidth * static_cast<std::size_t>(rows),
                                     code);
}

double mean(const std::vector<std::uint8_t>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Dither, LeavesBlackBlackAndWhiteWhite) {
  for (const auto& [code, byte] : {std::pair(0, 0), std::pair(65535, 255)})
    for (const std::uint8_t value : dithered(even_rows(static_cast<unsigned short>(code), 100)))
      ASSERT_EQ(value, byte);
}

// To 1e-4 of white, which is 6 of the standard deviations that are left of 1.5 million values.
TEST(Dither, KeepsTheMeanOfEveryCode) {
  for (const int code : {1, 40, 127, 128, 129, 200, 257, 300, 1000, 20'000, 32'768, 65'000, 65'278,
                         65'406, 65'407, 65'500, 65'534}) {
    const auto values = dithered(even_rows(static_cast<unsigned short>(code), 1000));
    EXPECT_NEAR(mean(values) / 255, code / 65535.0, 1e-4) << code;
    // No value is further away than the noise is wide.
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    EXPECT_LE(*most - code / 257.0, 1.5) << code;
    EXPECT_GE(*least - code / 257.0, -1.5) << code;
  }
}

// A dark gradient over five steps of 8 bits: rounded, it is off by up to half a step over a hundred
// columns, which the eye sees as a contour.  Dithered, the mean of each column follows it.
TEST(Dither, LeavesNoContoursInADarkGradient) {
  constexpr int kRows = 2000;
  std::vector<unsigned short> codes = even_rows(0, kRows);
  const auto code_at = [](int x) { return 300 + 5 * 257 * x / kWidth; };
  for (std::size_t k = 0; k < codes.size(); ++k)
    codes[k] = static_cast<unsigned short>(code_at(static_cast<int>(k / 3) % kWidth));
  const auto values = dithered(codes);
  double worst = 0, worst_rounded = 0;
  for (int x = 0; x < kWidth; ++x) {
    double sum = 0;
    for (std::size_t row = 0; row < kRows; ++row)
      for (std::size_t c = 0; c < 3; ++c)
        sum += values[3 * (row * kWidth + static_cast<std::size_t>(x)) + c];
    const double exact = code_at(x) / 257.0;
    worst = std::max(worst, std::abs(sum / (3 * kRows) - exact));
    worst_rounded = std::max(worst_rounded, std::abs(std::round(exact) - exact));
  }
  // The mean of 6000 values with a standard deviation of half a step.
  EXPECT_LT(worst, 5 * 0.5 / std::sqrt(6000));
  EXPECT_GT(worst_rounded, 0.49);
}

TEST(Dither, HasNoiseOfItsOwnInEveryFrameRowColumnAndChannel) {
  const auto half = even_rows(128 + 257 * 20, 2);
  const auto first = dithered(half);
  EXPECT_EQ(first, dithered(half)) << "the same frame has the same noise";
  EXPECT_NE(first, dithered(half, 1));
  EXPECT_NE(first, dithered(half, 0, 7));
  const std::size_t row = 3 * kWidth;
  const auto alike = [&](std::size_t shift) {
    int count = 0;
    for (std::size_t k = 0; k < row; ++k) count += first[k] == first[k + shift];
    return count / static_cast<double>(row);
  };
  // Of two independent values about half are alike.
  for (const std::size_t shift : {std::size_t{1}, std::size_t{3}, row})
    EXPECT_LT(alike(shift), 0.6);
}

// A strip is rounded as the frame that it is of.
TEST(Dither, DependsOnThePlaceInTheFrameAlone) {
  std::vector<unsigned short> codes(std::size_t{3} * kWidth * 10);
  std::iota(codes.begin(), codes.end(), static_cast<unsigned short>(900));
  const auto whole = dithered(codes, 5);
  const std::size_t row = 3 * kWidth;
  const std::vector<unsigned short> part(codes.begin() + 4 * row, codes.end());
  const auto strip = dithered(part, 5, 4);
  EXPECT_TRUE(std::equal(strip.begin(), strip.end(), whole.begin() + 4 * row));
}

}  // namespace
}  // namespace domefall
