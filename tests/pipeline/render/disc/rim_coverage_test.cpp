// A line narrower than a pixel has its light wherever it lies between pixels.
#include "pipeline/render/disc/rim_coverage.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

// The light of a line that crosses rows of pixels, or diagonals, `apart` pixels from one another.
double light_of_line(double at, double apart) {
  constexpr double kWidth = 1e-3;
  double sum = 0;
  for (int k = -4; k <= 4; ++k)
    sum += beyond_rim(at + kWidth - k * apart) - beyond_rim(at - k * apart);
  return sum * apart / kWidth;
}

TEST(RimCoverage, OfALineIsTheSameWhereverItLies) {
  for (double at = -0.5; at <= 0.5; at += 0.01) {
    EXPECT_NEAR(light_of_line(at, 1), 1, 1e-9) << at;
    EXPECT_NEAR(light_of_line(at, std::sqrt(0.5)), 1, 1e-9) << at;
    // Rows two columns long, between which it steps: the next pattern of parallel lines of pixels.
    EXPECT_NEAR(light_of_line(at, std::sqrt(0.2)), 1, 0.04) << at;
  }
}

TEST(RimCoverage, HasAnInverse) {
  for (double off = -kRimReach; off <= kRimReach; off += 0.01)
    EXPECT_NEAR(distance_to_rim(beyond_rim(off)), off, 1e-7);
  EXPECT_EQ(distance_to_rim(0.5), 0);
  EXPECT_EQ(beyond_rim(1), 1);
  EXPECT_EQ(beyond_rim(-1), 0);
}

}  // namespace
}  // namespace domefall
