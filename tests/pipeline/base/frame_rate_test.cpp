#include "pipeline/base/frame_rate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace domefall {
namespace {

TEST(FrameRate, DecimalsOfNtscAreThousandsOver1001) {
  EXPECT_EQ(frame_rate_of(23.976), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(23.976024), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(29.97), (FrameRate{30000, 1001}));
  EXPECT_EQ(frame_rate_of(47.952), (FrameRate{48000, 1001}));
  EXPECT_EQ(frame_rate_of(59.94), (FrameRate{60000, 1001}));
  EXPECT_EQ(frame_rate_of(119.88), (FrameRate{120000, 1001}));
  EXPECT_EQ(frame_rate_of(30000.0 / 1001), (FrameRate{30000, 1001}));
  // Rounded or cut off behind the second decimal, as people write them.
  EXPECT_EQ(frame_rate_of(23.98), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(23.97), (FrameRate{24000, 1001}));
  EXPECT_EQ(frame_rate_of(47.95), (FrameRate{48000, 1001}));
  EXPECT_EQ(frame_rate_of(89.91), (FrameRate{90000, 1001}));
  EXPECT_EQ(frame_rate_of(95.90), (FrameRate{96000, 1001}));
  EXPECT_EQ(frame_rate_of(239.76), (FrameRate{240000, 1001}));
}

TEST(FrameRate, WholeNumbersStayWhole) {
  for (int n = 1; n <= 240; ++n) EXPECT_EQ(frame_rate_of(n), (FrameRate{n, 1}));
}

TEST(FrameRate, OtherDecimalsAreExactFractions) {
  EXPECT_EQ(frame_rate_of(12.5), (FrameRate{25, 2}));
  EXPECT_EQ(frame_rate_of(23.9), (FrameRate{239, 10}));
  EXPECT_EQ(frame_rate_of(23.99), (FrameRate{2399, 100}));
  EXPECT_EQ(frame_rate_of(29.95), (FrameRate{599, 20}));
  EXPECT_EQ(frame_rate_of(24.975), (FrameRate{999, 40}));  // 25 has no rate of NTSC
  EXPECT_EQ(frame_rate_of(1.1), (FrameRate{11, 10}));
  EXPECT_EQ(frame_rate_of(100.0 / 3), (FrameRate{100, 3}));
}

TEST(FrameRate, AnyRateIsNearAFractionThatVideoCanCountIn) {
  for (double rate = 1; rate <= 240; rate += 0.0137) {
    const FrameRate found = frame_rate_of(rate);
    EXPECT_NEAR(static_cast<double>(found.frames) / static_cast<double>(found.seconds), rate,
                2e-6 * rate);
    EXPECT_LT(found.frames, 2'000'000'000);  // ffmpeg has 31 bits
  }
  EXPECT_LT(frame_rate_of(std::sqrt(2.0) * 10).frames, 2'000'000'000);
}

TEST(FrameRate, FractionsOfNumbersUpToAMillionAreExact) {
  EXPECT_EQ(frame_rate_of(1000.0 / 33), (FrameRate{1000, 33}));
  EXPECT_EQ(frame_rate_of(999983.0 / 41641), (FrameRate{999983, 41641}));
  EXPECT_EQ(frame_rate_of(1000001.0 / 999999), (FrameRate{1000001, 999999}));
}

TEST(FrameRate, FractionsAreReadFromText) {
  EXPECT_EQ(parse_frame_rate("24000/1001"), (FrameRate{24000, 1001}));
  EXPECT_EQ(parse_frame_rate("60/2"), (FrameRate{30, 1}));
  for (const char* text : {"", "24", "/", "24/", "/1001", "24/0", "0/1", "-24/1", "24/1.001",
                           "24/1/1", "24000 / 1001", "24000/1001 fps", "99999999999999999999/1"})
    EXPECT_EQ(parse_frame_rate(text), (FrameRate{0, 0})) << text;
}

TEST(FrameRate, ItsTextAndDurationAreThoseOfTheFraction) {
  EXPECT_EQ(text_of({30, 1}), "30");
  EXPECT_EQ(text_of({24000, 1001}), "24000/1001");
  EXPECT_DOUBLE_EQ(duration_of(24000, {24000, 1001}), 1001);
}

}  // namespace
}  // namespace domefall
